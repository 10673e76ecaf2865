#version 300 es
precision highp float;

// A mesh, instance by instance, lit at its vertices: what each leaves toward the eye by its table of reflectance
// coefficients. Only the side that normals point to is lit; the other looks as if seen from the horizon.

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_texcoord;
layout(location = 3) in vec3 a_color;
layout(location = 4) in vec3 a_tangent;
layout(location = 5) in vec3 a_shadow;

uniform mat4 u_object_to_clip;
uniform mat4 u_object_to_eye;  // axes of the light's frame, the eye in the origin
uniform mat3 u_normal_to_light;

out vec3 v_plain;
out vec3 v_tinted;
out vec2 v_texcoord;
out vec3 v_color;

void reflect_light(vec3 n, vec3 tangent, vec3 to_eye, out vec3 plain, out vec3 tinted);

void main() {
  vec3 n = u_normal_to_light * a_normal;
  n *= inversesqrt(max(dot(n, n), 1e-20));
  reflect_light(n, (u_object_to_eye * vec4(a_tangent, 0.0)).xyz, -(u_object_to_eye * vec4(a_position, 1.0)).xyz,
                v_plain, v_tinted);
  v_plain *= a_shadow, v_tinted *= a_shadow;
  v_texcoord = a_texcoord;
  v_color = a_color;
  gl_Position = u_object_to_clip * vec4(a_position, 1.0);
}
