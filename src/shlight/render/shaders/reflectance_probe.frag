#version 300 es
precision highp float;
precision highp sampler2D;

// Evaluates the very eval_reflectance that pictures are drawn with, one normal and tangent a pixel.

uniform sampler2D u_input0;  // normals
uniform sampler2D u_input1;  // tangents

uniform vec3 u_base_color;

out vec4 o_value;


void eval_reflectance(vec3 n, vec3 t, out vec3 plain, out vec3 tinted);

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 plain, tinted;
  eval_reflectance(texelFetch(u_input0, pixel, 0).xyz, texelFetch(u_input1, pixel, 0).xyz, plain, tinted);
  o_value = vec4(plain + u_base_color * tinted, 1.0);
}
