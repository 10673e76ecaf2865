#version 300 es

// A mesh, instance by instance. Normals go to the frame in which the light's coefficients are: turning the light is
// turning every normal the other way.

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_texcoord;
layout(location = 3) in vec3 a_color;
layout(location = 4) in vec3 a_tangent;
layout(location = 5) in vec3 a_shadow;

uniform mat4 u_object_to_clip;
uniform mat4 u_object_to_eye;  // axes of the light's frame, the eye in the origin
uniform mat3 u_normal_to_light;

out highp vec3 v_normal;  // of unit length
out highp vec3 v_tangent;  // of any length
out highp vec3 v_to_eye;   // of any length
flat out highp vec3 v_normal_nearby;
flat out highp vec3 v_to_eye_nearby;
out highp vec2 v_texcoord;
out highp vec3 v_color;
out highp vec3 v_shadow;  // factor of radiance

void main() {
  vec3 normal = u_normal_to_light * a_normal;
  v_normal = v_normal_nearby = normal * inversesqrt(max(dot(normal, normal), 1e-20));
  v_tangent = (u_object_to_eye * vec4(a_tangent, 0.0)).xyz;
  v_to_eye = v_to_eye_nearby = -(u_object_to_eye * vec4(a_position, 1.0)).xyz;
  v_texcoord = a_texcoord;
  v_color = a_color;
  v_shadow = a_shadow;
  gl_Position = u_object_to_clip * vec4(a_position, 1.0);
}
