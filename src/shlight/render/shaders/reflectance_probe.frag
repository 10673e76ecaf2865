#version 300 es
precision highp float;
precision highp sampler2D;

// Evaluates the very eval_reflectance that pictures are drawn with, one normal and tangent a pixel.

uniform sampler2D u_input0;  // normals
uniform sampler2D u_input1;  // tangents

out vec4 o_value;

vec3 eval_reflectance(vec3 n, vec3 t);

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  o_value = vec4(eval_reflectance(texelFetch(u_input0, pixel, 0).xyz, texelFetch(u_input1, pixel, 0).xyz), 1.0);
}
