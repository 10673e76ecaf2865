
// To surface.frag: radiance E(n) / pi, of a surface that sees the whole distant light.

in vec3 v_normal;

const float kInversePi = 0.318309886;

vec3 eval_sh(vec3 n);  // irradiance

vec3 white_radiance() {
  // Interpolation shortens a normal; one of length zero stays finite.
  vec3 n = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-20));
  return kInversePi * eval_sh(gl_FrontFacing ? n : -n);
}
