// The coordinates that the scene carries; those it does not carry arrive as 0.
layout(location = 0) in vec3 carried;
// What the element is coloured by, where that is a value of elements.
layout(location = 1) in float value;

uniform mat4 to_view;  // carried coordinates to view space
uniform mat4 to_clip;  // view space to clip space
uniform float point_size;

out vec3 in_view;
out float value_here;

void main() {
  vec4 view = to_view * vec4(carried, 1.0);
  in_view = view.xyz;
  value_here = value;
  gl_Position = to_clip * view;
  gl_PointSize = point_size;
}
