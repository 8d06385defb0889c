// Estimates from the depths how much of the light from all sides the surface around a pixel hides (McGuire and others
// 2011, "The Alchemy screen-space ambient obscurance algorithm").
uniform sampler2D depths;
uniform mat4 from_clip;     // clip space to view space
uniform float reach;        // radius of the neighbourhood, in the unit of view space
uniform float pixel_reach;  // the same in fractions of the picture's height, at distance 1 in clip space
uniform float aspect;       // of the picture
uniform bool perspective;
uniform vec2 texel;         // size of a pixel of `depths`

out float occlusion;

const int samples = 10;

// Returns the point that a pixel of `depths` shows.
vec3 view_at(ivec2 pixel) {
  pixel = clamp(pixel, ivec2(0), textureSize(depths, 0) - 1);
  vec2 at = (vec2(pixel) + 0.5) * texel;
  vec4 view = from_clip * vec4(2.0 * at - 1.0, 2.0 * texelFetch(depths, pixel, 0).r - 1.0, 1.0);
  return view.xyz / view.w;
}

// Returns the shorter of two steps, so that the step does not cross the edge of the object.
vec3 shorter(vec3 a, vec3 b) { return dot(a, a) < dot(b, b) ? a : b; }

void main() {
  ivec2 pixel = 2 * ivec2(gl_FragCoord.xy); // this picture has half the resolution
  if (texelFetch(depths, pixel, 0).r >= 1.0) {
    occlusion = 0.0;
    return;
  }
  vec3 here = view_at(pixel);
  vec3 across = shorter(view_at(pixel + ivec2(1, 0)) - here, here - view_at(pixel - ivec2(1, 0)));
  vec3 up = shorter(view_at(pixel + ivec2(0, 1)) - here, here - view_at(pixel - ivec2(0, 1)));
  vec3 normal = normalize(cross(across, up));
  float radius = min(pixel_reach / (perspective ? -here.z : 1.0), 0.15);
  // Each pixel of a block of 4 by 4 turns its samples differently; the mean over the block removes the pattern.
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  float turn = float((cell.x * 4 + cell.y * 7 + (cell.x ^ cell.y) * 5) & 15) * 0.3927;
  float hidden = 0.0;
  for (int i = 0; i < samples; ++i) {
    float along = (float(i) + 0.5) / float(samples);
    float angle = along * 43.98 + turn; // seven turns of the spiral
    vec2 step_to = along * radius * vec2(cos(angle) / aspect, sin(angle));
    vec3 way = view_at(pixel + ivec2(round(step_to / texel))) - here;
    float squared = dot(way, way);
    float weight = max(0.0, 1.0 - squared / (reach * reach));
    hidden += weight * max(0.0, dot(way, normal) - 0.04 * reach) / (sqrt(squared) + 0.001 * reach);
  }
  occlusion = clamp(1.6 * hidden / float(samples), 0.0, 1.0);
}
