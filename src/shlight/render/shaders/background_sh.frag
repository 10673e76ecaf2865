#version 300 es
precision highp float;

// The environment at infinity, as the light's coefficients reconstruct it.

in vec2 v_ndc;

uniform mat3 u_ndc_to_light;  // (x, y, 1) of the picture to a direction in the light's frame, not of unit length

out vec4 o_radiance;

vec3 eval_sh(vec3 n);  // radiance

void main() {
  o_radiance = vec4(max(eval_sh(normalize(u_ndc_to_light * vec3(v_ndc, 1.0))), 0.0), 1.0);
}
