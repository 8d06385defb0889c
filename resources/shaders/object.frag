#version 330 core

in vec3 in_view;

uniform vec4 colour;
uniform vec4 background;
uniform vec2 fog;    // distances from the eye at which fading begins and ends; equal: none
uniform int shading; // 0 plain, 1 a face lit from the eye, 2 a round point

out vec4 fragment;

void main() {
  vec4 result = colour;
  if (shading == 1) {
    vec3 normal = normalize(cross(dFdx(in_view), dFdy(in_view)));
    result.rgb *= 0.55 + 0.45 * abs(normal.z);
  } else if (shading == 2) {
    float beyond = length(gl_PointCoord - 0.5) - 0.5;
    float edge = fwidth(beyond);
    result.a *= 1.0 - smoothstep(-edge, 0.0, beyond);
  }
  if (fog.y > fog.x) {
    result.rgb = mix(result.rgb, background.rgb, 0.75 * clamp((-in_view.z - fog.x) / (fog.y - fog.x), 0.0, 1.0));
  }
  fragment = result;
}
