#version 300 es
precision highp float;
precision highp sampler2D;

// The environment at infinity, from a lat-long picture: its centre is -Z, its right is +X, its top +Y.

in vec2 v_ndc;

uniform mat3 u_ndc_to_light;  // (x, y, 1) of the picture to a direction in the light's frame, not of unit length
uniform sampler2D u_image;    // rows from the top: v = 0 is +Y

out vec4 o_radiance;

const float kPi = 3.14159265;

void main() {
  vec3 d = normalize(u_ndc_to_light * vec3(v_ndc, 1.0));
  vec2 uv = vec2(0.5 + atan(d.x, -d.z) / (2.0 * kPi), 0.5 - asin(clamp(d.y, -1.0, 1.0)) / kPi);
  // With level 0 stated, the jump of u at azimuth +-180 degrees chooses no smaller level: there is no seam.
  o_radiance = vec4(max(textureLod(u_image, uv, 0.0).rgb, 0.0), 1.0);
}
