// What follows is compiled once for each pair of SHADING and COLOURED_BY: a software renderer takes every branch
// at every pixel.
//   SHADING: 0 plain, 1 a face lit from the eye; points: 2 a disc, 3 a diamond, 4 a ring
//   COLOURED_BY: 0 `colour`, 1 the elements' values, 2 the links' (a primitive is a link), 3 a picture, 4 a volume

in vec3 in_view;
in float value_here;
in vec3 rest_here;

uniform vec4 colour;
uniform vec4 background;
uniform float darkest; // how dark a face is that is seen from its side, of 1
uniform vec2 fog;    // distances from the eye at which fading begins and ends; equal: none

uniform samplerBuffer link_values;
uniform sampler2D picture;
uniform sampler3D volume;
uniform vec3 texture_scale, texture_offset; // from places at rest to those in the texture, 0 to 1
uniform vec3 stops[6];   // the colour map's control points
uniform vec2 range;      // the values at its two ends
uniform float threshold; // a value that is no larger, whatever its sign, is neutral
uniform vec4 neutral;

out vec4 fragment;

vec4 mapped(float value) {
  if (abs(value) <= threshold) {
    return neutral;
  }
  float share = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) : 0.0;
  int from = min(int(share * 5.0), 4);
  return vec4(mix(stops[from], stops[from + 1], share * 5.0 - float(from)), 1.0);
}

#if SHADING >= 2
// How far a place of a point lies outside its mark, in point sizes.
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
  vec4 result = mapped(texelFetch(link_values, gl_PrimitiveID).r);
#elif COLOURED_BY == 3
  vec4 result = texture(picture, (rest_here * texture_scale + texture_offset).xy);
#elif COLOURED_BY == 4
  vec4 result = vec4(texture(volume, rest_here * texture_scale + texture_offset).rgb, 1.0);
#else
  vec4 result = colour;
#endif
#if SHADING == 1
  vec3 normal = normalize(cross(dFdx(in_view), dFdy(in_view)));
  result.rgb *= mix(darkest, 1.0, abs(normal.z));
#elif SHADING >= 2
  float beyond = outside(gl_PointCoord - 0.5);
  float edge = fwidth(beyond);
  result.a *= 1.0 - smoothstep(-edge, 0.0, beyond);
#endif
  if (fog.y > fog.x) {
    result.rgb = mix(result.rgb, background.rgb, 0.75 * clamp((-in_view.z - fog.x) / (fog.y - fog.x), 0.0, 1.0));
  }
  fragment = result;
}
