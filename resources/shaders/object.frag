// Compiled once for each pair of SHADING and COLOURED_BY, because a software renderer executes every branch at every
// pixel.
//   SHADING: 0 plain, 1 a lit face; points: 2 a disc, 3 a diamond, 4 a ring; 5 a face in a plane, darker if folded
//   COLOURED_BY: 0 `colour`, 1 values of elements, 2 values of links (a primitive is a link), 3 a picture, 4 a volume

in vec3 in_view;
in vec3 normal_here;
in float value_here;
in vec3 rest_here;

uniform vec4 colour;
uniform vec4 background;
uniform vec4 light;       // everywhere, sky, key, edge: see Lighting in ui/drawing/object_drawing.h
uniform float glint;
uniform float front_sign; // 1 if faces that are not folded are counterclockwise in the view, otherwise -1; 0: unknown
uniform vec2 fog;         // distances from the eye at which fading begins and ends; equal: none
uniform float fade;       // largest fading

uniform samplerBuffer link_values;
uniform sampler2D picture;
uniform sampler3D volume;
uniform vec3 texture_scale, texture_offset; // from rest positions to positions in the texture, 0 to 1
uniform vec3 stops[6];   // the colour map's control points
uniform vec2 range;      // the values at its two ends
uniform float threshold; // values that differ from `centre` by at most this are neutral
uniform float centre;
uniform bool diverging;   // the centre is in the middle of the map, with a range on each side
uniform bool logarithmic; // equal ratios of values are equally far apart
uniform int first_value;  // of the drawn links, in link_values
uniform vec4 neutral;

out vec4 fragment;

vec4 mapped(float value) {
  if (abs(value - centre) <= threshold) {
    return neutral;
  }
  vec2 ends = !diverging ? range
              : value < centre ? vec2(range.x, 2.0 * centre - range.x) : vec2(2.0 * centre - range.y, range.y);
  if (logarithmic) {
    value = log(max(value, range.x));
    ends = log(range);
  }
  float share = ends.y > ends.x ? clamp((value - ends.x) / (ends.y - ends.x), 0.0, 1.0) : 0.0;
  int from = min(int(share * 5.0), 4);
  return vec4(mix(stops[from], stops[from + 1], share * 5.0 - float(from)), 1.0);
}

#if SHADING == 1
// Returns the smooth normal towards the viewer, or that of the face if the two differ much.
vec3 normal_seen() {
  vec3 of_face = normalize(cross(dFdx(in_view), dFdy(in_view)));
  float size = dot(normal_here, normal_here);
  vec3 smooth_one = size > 0.0 ? normal_here * inversesqrt(size) : of_face;
  float agree = dot(smooth_one, of_face);
  smooth_one = agree < 0.0 ? -smooth_one : smooth_one;
  return normalize(mix(of_face, smooth_one, smoothstep(0.5, 0.8, abs(agree))));
}

const vec3 to_key = normalize(vec3(-0.42, 0.58, 0.70));
const vec3 halfway = normalize(to_key + vec3(0.0, 0.0, 1.0));

vec3 lit(vec3 of_surface) {
  vec3 normal = normal_seen();
  of_surface *= light.x + light.y * (0.5 + 0.5 * normal.y) + light.z * max(0.0, dot(normal, to_key));
#if COLOURED_BY == 0
  float grazing = 1.0 - clamp(normal.z, 0.0, 1.0);
  float rim = light.w * grazing * grazing * grazing;
  of_surface = rim > 0.0 ? mix(of_surface, vec3(1.0), rim) : of_surface * (1.0 + rim);
  of_surface += glint * pow(max(0.0, dot(normal, halfway)), 32.0);
#endif
  return of_surface;
}
#endif

#if SHADING >= 2 && SHADING <= 4
// Returns how far a position of a point is outside its mark, in point sizes.
float outside(vec2 place) {
  if (SHADING == 3) {
    return abs(place.x) + abs(place.y) - 0.5;
  }
  float from_centre = length(place);
  return SHADING == 4 ? max(from_centre - 0.5, 0.32 - from_centre) : from_centre - 0.5;
}
#endif

void main() {
#if COLOURED_BY == 1
  vec4 result = mapped(value_here);
#elif COLOURED_BY == 2
  vec4 result = mapped(texelFetch(link_values, first_value + gl_PrimitiveID).r);
#elif COLOURED_BY == 3
  vec4 result = texture(picture, (rest_here * texture_scale + texture_offset).xy);
#elif COLOURED_BY == 4
  vec4 result = vec4(texture(volume, rest_here * texture_scale + texture_offset).rgb, 1.0);
#else
  vec4 result = colour;
#endif
#if SHADING == 1
  result.rgb = lit(result.rgb);
#elif SHADING == 5
  if ((gl_FrontFacing ? front_sign : -front_sign) < 0.0) {
    result.rgb *= COLOURED_BY == 0 ? 0.55 : 0.75;
    result.a = min(1.0, result.a + 0.3);
  }
#elif SHADING >= 2
  float beyond = outside(gl_PointCoord - 0.5);
  float edge = fwidth(beyond);
  result.a *= 1.0 - smoothstep(-edge, 0.0, beyond);
#endif
  if (fog.y > fog.x) {
    result.rgb = mix(result.rgb, background.rgb, fade * clamp((-in_view.z - fog.x) / (fog.y - fog.x), 0.0, 1.0));
  }
  fragment = result;
}
