// The coordinates that the scene carries; those it does not carry arrive as 0.
layout(location = 0) in vec3 carried;
// What the element is coloured by, where that is a value of elements.
layout(location = 1) in float value;
// Where it is at rest, in lengths of the object's box.
layout(location = 2) in vec3 at_rest;

uniform mat4 to_view;  // carried coordinates to view space
uniform mat4 to_clip;  // view space to clip space
uniform float point_size;
uniform vec4 section; // its product with a place at rest and 1 is negative in front of the plane

out vec3 in_view;
out float value_here;
out vec3 rest_here;
out float gl_ClipDistance[1];

void main() {
  vec4 view = to_view * vec4(carried, 1.0);
  in_view = view.xyz;
  value_here = value;
  gl_Position = to_clip * view;
  rest_here = at_rest;
  gl_ClipDistance[0] = dot(section, vec4(at_rest, 1.0)); // counts where it is switched on
  gl_PointSize = point_size;
}
