
// To surface.frag: the normal as a colour that a picture cut off at 1 shows as (1 + n) / 2. With seen_normal.glsl.

void see(out vec3 n, out vec3 to_eye);

vec3 radiance_of(vec3 base_color) {
  vec3 n, to_eye;
  see(n, to_eye);
  vec3 shown = 0.5 + 0.5 * n;
  // IEC 61966-2-1, to linear light, of which the picture is made.
  return mix(pow((shown + 0.055) / 1.055, vec3(2.4)), shown / 12.92, vec3(lessThan(shown, vec3(0.04045))));
}
