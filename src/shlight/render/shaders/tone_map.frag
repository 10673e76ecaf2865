#version 300 es
precision highp float;
precision highp sampler2D;

// Linear radiance to an sRGB picture: exposure, tone mapper, transfer function.

uniform sampler2D u_radiance;
uniform float u_exposure;  // a factor
uniform bool u_filmic;     // else cut off at 1

out vec4 o_color;

// A log-logistic curve on each channel: straight over log light in the middle, it bends toward 0 and 1 without a corner
// (the response of Naka and Rushton; Reinhard and Devlin: Dynamic Range Reduction Inspired by Photoreceptor Physiology,
// IEEE TVCG 11(1), 2005). Channels are mixed before the curve and unmixed after it, as in Sobotka's AgX
// (github.com/sobotka/AgX), so that bright colours go to white and not to the corners of the cube.
//
// Chosen by eye on real lights: Khronos PBR Neutral, which keeps base colours exactly, turns skies at sunset into flat
// patches of pink; Hable's curve keeps bright blue lamps fully blue.
vec3 tone_map(vec3 color) {
  const float kMiddle = 0.18;   // stays where it is
  const float kContrast = 1.4;  // the curve's exponent
  const float kMix = 0.24;      // how far each channel goes toward the mean of all three, about as far as AgX's matrix
  const vec3 kMean = vec3(1.0 / 3.0);
  vec3 power = pow(mix(color, vec3(dot(color, kMean)), kMix) / kMiddle, vec3(kContrast));
  vec3 curve = power / (power + (1.0 - kMiddle) / kMiddle);
  return clamp((curve - kMix * dot(curve, kMean)) / (1.0 - kMix), 0.0, 1.0);
}

// IEC 61966-2-1.
vec3 encode_srgb(vec3 linear) {
  vec3 curve = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(curve, 12.92 * linear, vec3(lessThan(linear, vec3(0.0031308))));
}

void main() {
  vec3 radiance = texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  // The upper limit, far in the white, keeps infinity out of the curve.
  vec3 exposed = clamp(radiance * u_exposure, 0.0, 1e6);
  o_color = vec4(encode_srgb(u_filmic ? tone_map(exposed) : min(exposed, 1.0)), 1.0);
}
