
// The radiance that a surface leaves toward the eye, by its table of reflectance coefficients: layer k of the texture
// holds reflectance_texel(k) of all views, placed as brdf/reflectance_table.h says. ANISOTROPIC is defined where the
// table is of both the view's polar angle and its azimuth from the tangent; COLORED, where the colours of its two parts
// are a model's own; HIGHLIGHT_LAYER, the first of two layers with the albedo of highlights, plain and tinted, where
// those reflect the light's residual too. For vertex and fragment shaders.

uniform highp sampler2DArray u_reflectance;

#ifdef HIGHLIGHT_LAYER
uniform highp samplerCube u_residual;  // averaged over the slim side of the highlight
uniform float u_slopes[LOBE_TAPS];     // of half vectors along its wide side; the first alone where it is isotropic
uniform bool u_wide_along_x;
#endif

#ifdef COLORED
uniform vec3 u_plain_color;
uniform vec3 u_tinted_color;
#endif

void eval_reflectance(vec3 n, vec3 t, out vec3 plain, out vec3 tinted);

vec2 g_place;  // of the view in the texture

vec4 reflectance_texel(int k) { return textureLod(u_reflectance, vec3(g_place, float(k)), 0.0); }

// `v` made orthogonal to n and of unit length; any such vector where v is along n.
vec3 unit_along_surface(vec3 v, vec3 n) {
  vec3 along = v - dot(v, n) * n;
  if (dot(along, along) < 1e-12) along = abs(n.y) < 0.9 ? vec3(n.z, 0.0, -n.x) : vec3(0.0, -n.z, n.y);
  return normalize(along);
}

// n is of unit length. What an interpolated normal turns away from the eye is seen from the horizon.
void reflect_light(vec3 n, vec3 tangent, vec3 to_eye, out vec3 plain, out vec3 tinted) {
  vec3 v = normalize(to_eye);
  float x = 1.0 - sqrt(1.0 - clamp(dot(n, v), 0.0, 1.0));
  float position = 1.0 - 0.5 * (x + sqrt(x));
  vec2 size = vec2(textureSize(u_reflectance, 0).xy);
#ifdef ANISOTROPIC
  vec3 t = unit_along_surface(tangent, n), along = unit_along_surface(v, n);
  vec2 azimuth = vec2(dot(along, t), dot(along, cross(n, t)));
  g_place = (0.5 + (0.5 + 0.5 * position * azimuth) * (size - 1.0)) / size;
#else
  vec3 t = unit_along_surface(v, n);
  g_place = vec2((0.5 + position * (size.x - 1.0)) / size.x, 0.5);
#endif
  eval_reflectance(n, t, plain, tinted);
#ifdef COLORED
  plain = u_plain_color * plain + u_tinted_color * tinted;
  tinted = vec3(0.0);
#endif
#ifdef HIGHLIGHT_LAYER
#ifdef ANISOTROPIC
  vec3 residual = vec3(0.0), wide = u_wide_along_x ? t : cross(n, t);
  for (int k = 0; k < LOBE_TAPS; ++k)
    residual += 1.0 / float(LOBE_TAPS) * textureLod(u_residual, reflect(-v, normalize(n + u_slopes[k] * wide)), 0.0).rgb;
#else
  vec3 residual = textureLod(u_residual, reflect(-v, n), 0.0).rgb;
#endif
  plain += residual * reflectance_texel(HIGHLIGHT_LAYER).rgb;
  tinted += residual * reflectance_texel(HIGHLIGHT_LAYER + 1).rgb;
#endif
}
