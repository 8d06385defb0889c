// The coordinates on the axes of the mesh; the others are 0.
layout(location = 0) in vec3 carried;
// The value of the element, if values of elements colour the object.
layout(location = 1) in float value;
// The rest position, as a fraction of the longest side of the object's box.
layout(location = 2) in vec3 at_rest;
// The smooth normal on the axes of the mesh; 0 if there is none.
layout(location = 3) in vec3 normal;

uniform mat4 to_view;  // carried coordinates to view space
uniform mat4 to_clip;  // view space to clip space
uniform float point_size;
uniform vec4 section; // its product with (rest position, 1) is negative in front of the plane

out vec3 in_view;
out vec3 normal_here;
out float value_here;
out vec3 rest_here;
out float gl_ClipDistance[1];

void main() {
  vec4 view = to_view * vec4(carried, 1.0);
  in_view = view.xyz;
  normal_here = mat3(to_view) * normal;
  value_here = value;
  gl_Position = to_clip * view;
  rest_here = at_rest;
  gl_ClipDistance[0] = dot(section, vec4(at_rest, 1.0)); // has an effect only if it is switched on
  gl_PointSize = point_size;
}
