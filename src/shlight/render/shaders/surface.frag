#version 300 es
precision highp float;
precision highp sampler2D;

// A surface: what it leaves toward the eye, which each method defines in its own way.

in vec2 v_texcoord;
in vec3 v_color;

uniform vec3 u_base_color;
uniform sampler2D u_texture;  // white where the material has none
uniform vec3 u_negative;      // stripes where a channel of the light is negative; black: no stripes

out vec4 o_radiance;

vec3 radiance_of(vec3 base_color);  // not clamped

void main() {
  vec3 base_color = u_base_color * v_color * texture(u_texture, v_texcoord).rgb;
  // A light that is cut off at few bands is negative in some directions, and so is what it lights.
  vec3 radiance = radiance_of(base_color);
  o_radiance = vec4(max(radiance, 0.0), 1.0);
  bool stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 10.0) < 0.5;
  if (u_negative != vec3(0.0) && stripe && any(lessThan(radiance, vec3(0.0)))) o_radiance.rgb = u_negative;
}
