
// The radiance that a surface leaves toward the eye, by its table of reflectance coefficients: layer k of the texture
// holds reflectance_texel(k) of all views, placed as brdf/reflectance_table.h says. ANISOTROPIC is defined where the
// table is of both the view's polar angle and its azimuth from the tangent; COLORED, where the colours of its two parts
// are a model's own; HIGHLIGHT_LAYER, the first of two layers with the albedo of highlights, plain and tinted, where
// those reflect the light's residual too; SUN, where surfaces reflect the sun; CHANNELS, as ReflectanceGlslParams has
// them. For vertex and fragment shaders.

uniform highp sampler2DArray u_reflectance;

#ifdef HIGHLIGHT_LAYER
uniform highp samplerCube u_residual;  // averaged over the slim side of the highlight
uniform float u_slopes[LOBE_TAPS];     // of half vectors along its wide side; the first alone where it is isotropic
uniform bool u_wide_along_x;
#endif

#ifdef SUN
uniform vec3 u_to_sun;  // in the light's frame, where all directions here are
uniform vec3 u_sun_irradiance;
uniform highp sampler2D u_slope_density;  // LobeFromAbove::slope_density
uniform vec3 u_slope_scale;               // of slopes along t and across; the lobe's width
#endif

#ifdef COLORED
uniform vec3 u_plain_color;
uniform vec3 u_tinted_color;
#endif

void eval_reflectance(vec3 n, vec3 t, out vec3 plain, out vec3 tinted);

vec2 g_place;  // of the view in the texture

vec4 reflectance_texel(int k) { return textureLod(u_reflectance, vec3(g_place, float(k)), 0.0); }

// Of a model in colours of its own: no base colour tints it.
void apply_colors(inout vec3 plain, inout vec3 tinted) {
#ifdef COLORED
  plain = u_plain_color * plain + u_tinted_color * tinted;
  tinted = vec3(0.0);
#endif
}

#ifdef SUN
// The reflected share of light that is the same from everywhere, by the table's first coefficient.
void albedo(out vec3 plain, out vec3 tinted) {
  vec4 first = 3.5449077 * reflectance_texel(0);  // √4π
#if CHANNELS == 3
  plain = first.rgb;
  tinted = vec3(0.0);
#elif CHANNELS == 2
  plain = first.yyy;
  tinted = first.xxx;
#else
  plain = first.xxx;
  tinted = vec3(0.0);
#endif
  apply_colors(plain, tinted);
}

// What a surface that reflects all leaves toward v of the sun. Facets have the slopes of the lobe from above and hide
// each other as the sides of grooves do (Cook and Torrance 1982), which dims the horizon's both sides alike.
vec3 reflect_sun(vec3 n, vec3 t, vec3 v) {
  float n_sun = dot(n, u_to_sun), n_v = dot(n, v);
  vec3 half_way = u_to_sun + v;
  float len = length(half_way);
  if (n_sun <= 0.0 || n_v <= 0.0 || len < 1e-4) return vec3(0.0);
  half_way /= len;
  float n_h = dot(n, half_way), v_h = 0.5 * len;
  vec2 slope = u_slope_scale.xy * vec2(dot(t, half_way), dot(cross(n, t), half_way)) / n_h;
  float r = length(slope), steps = float(textureSize(u_slope_density, 0).x - 1);
  float x = (0.5 + steps * r / (r + u_slope_scale.z)) / (steps + 1.0);
  float facets = textureLod(u_slope_density, vec2(x, 0.5), 0.0).r / (n_h * n_h * n_h * n_h);
  float open = min(1.0, 2.0 * n_h * min(n_v, n_sun) / v_h);
  return u_sun_irradiance * facets * open / (4.0 * n_v);
}
#endif

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
  apply_colors(plain, tinted);
#ifdef HIGHLIGHT_LAYER
#ifdef ANISOTROPIC
  vec3 residual = vec3(0.0), wide = u_wide_along_x ? t : cross(n, t);
  float n_v = max(dot(n, v), 1e-3), all_facets = 0.0;
  for (int k = 0; k < LOBE_TAPS; ++k) {
    vec3 half_way = normalize(n + u_slopes[k] * wide);
    float v_h = dot(v, half_way), n_h = dot(n, half_way), n_light = 2.0 * v_h * n_h - n_v;
    // How much of them the eye sees and the light reaches, grooves between.
    float facets = max(min(v_h / (n_v * n_h), 2.0 * min(1.0, n_light / n_v)), 0.0);
    residual += facets * textureLod(u_residual, reflect(-v, half_way), 0.0).rgb;
    all_facets += facets;
  }
  residual /= max(all_facets, 1e-3);
#else
  vec3 residual = textureLod(u_residual, reflect(-v, n), 0.0).rgb;
#endif
  vec3 plain_highlight = reflectance_texel(HIGHLIGHT_LAYER).rgb;
  vec3 tinted_highlight = reflectance_texel(HIGHLIGHT_LAYER + 1).rgb;
#ifdef SUN
  residual += reflect_sun(n, t, v);
  // What else is reflected is diffuse: of the sun's irradiance, as much as the albedo is more than the highlight's.
  vec3 plain_albedo, tinted_albedo;
  albedo(plain_albedo, tinted_albedo);
  vec3 diffuse = u_sun_irradiance * max(dot(n, u_to_sun), 0.0) / 3.14159265;
  plain += diffuse * max(plain_albedo - plain_highlight, 0.0);
  tinted += diffuse * max(tinted_albedo - tinted_highlight, 0.0);
#endif
  plain += residual * plain_highlight;
  tinted += residual * tinted_highlight;
#endif
}
