#version 300 es
precision highp float;
precision highp sampler2D;

// Lambertian radiance, rho / pi * E(n), of a surface that sees the whole distant light.

in vec3 v_normal;
in vec2 v_texcoord;
in vec3 v_color;

uniform vec3 u_base_color;
uniform sampler2D u_texture;  // white where the material has none
uniform vec3 u_negative;      // stripes where a channel of the irradiance is negative; black: no stripes

out vec4 o_radiance;

const float kInversePi = 0.318309886;

vec3 eval_sh(vec3 n);  // irradiance

void main() {
  // Interpolation shortens a normal; one of length zero stays finite.
  vec3 n = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-20));
  if (!gl_FrontFacing) n = -n;
  vec3 base_color = u_base_color * v_color * texture(u_texture, v_texcoord).rgb;
  // A light that is cut off at few bands has directions of negative irradiance.
  vec3 irradiance = eval_sh(n);
  o_radiance = vec4(base_color * kInversePi * max(irradiance, 0.0), 1.0);
  bool stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 10.0) < 0.5;
  if (u_negative != vec3(0.0) && stripe && any(lessThan(irradiance, vec3(0.0)))) o_radiance.rgb = u_negative;
}
