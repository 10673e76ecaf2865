
// The radiance that a surface leaves toward the eye, by its table of reflectance coefficients: layer k of the texture
// holds reflectance_texel(k) of all views, placed as brdf/reflectance_table.h says. ANISOTROPIC is defined where the
// table is of both the view's polar angle and its azimuth from the tangent; HIGHLIGHT_LAYER, the first of two layers with
// the albedo of highlights, plain and tinted, where those reflect the light's residual too. For vertex and fragment
// shaders.

uniform highp sampler2DArray u_reflectance;

#ifdef HIGHLIGHT_LAYER
uniform highp samplerCube u_residual;  // averaged over the slim side of the highlight
uniform float u_slopes[LOBE_TAPS];     // of half vectors along its wide side; the first alone where it is isotropic
uniform bool u_wide_along_x;
#endif

void eval_reflectance(vec3 n, vec3 t, out vec3 plain, out vec3 tinted);

ivec2 g_first;  // of the entries around the view
vec2 g_share;   // of the next ones

vec4 reflectance_texel(int k) {
  ivec3 place = ivec3(g_first, k);
  vec4 row = mix(texelFetch(u_reflectance, place, 0), texelFetch(u_reflectance, place + ivec3(1, 0, 0), 0), g_share.x);
#ifdef ANISOTROPIC
  vec4 next = mix(texelFetch(u_reflectance, place + ivec3(0, 1, 0), 0),
                  texelFetch(u_reflectance, place + ivec3(1, 1, 0), 0), g_share.x);
  return mix(row, next, g_share.y);
#else
  return row;
#endif
}

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
  ivec2 last = textureSize(u_reflectance, 0).xy - 1;
#ifdef ANISOTROPIC
  vec3 t = unit_along_surface(tangent, n), along = unit_along_surface(v, n);
  vec2 azimuth = vec2(dot(along, t), dot(along, cross(n, t)));
  vec2 place = (0.5 + 0.5 * position * azimuth) * vec2(last);
  g_first = min(ivec2(place), last - 1);
#else
  vec3 t = unit_along_surface(v, n);
  vec2 place = vec2(position * float(last.x), 0.0);
  g_first = ivec2(min(int(place.x), last.x - 1), 0);
#endif
  g_share = place - vec2(g_first);
  eval_reflectance(n, t, plain, tinted);
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
