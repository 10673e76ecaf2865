#version 300 es
precision highp float;
precision highp sampler2D;

// Evaluates the very eval_sh that pictures are drawn with, one direction a pixel.

uniform sampler2D u_input0;

out vec4 o_value;

vec3 eval_sh(vec3 n);

void main() { o_value = vec4(eval_sh(texelFetch(u_input0, ivec2(gl_FragCoord.xy), 0).xyz), 1.0); }
