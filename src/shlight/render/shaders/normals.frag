
// To surface.frag: the normal as a colour that a picture cut off at 1 shows as (1 + n) / 2. With seen_normal.glsl.

vec3 seen_normal();

vec3 radiance_of(vec3 base_color) {
  vec3 shown = 0.5 + 0.5 * seen_normal();
  // IEC 61966-2-1, to linear light, of which the picture is made.
  return mix(pow((shown + 0.055) / 1.055, vec3(2.4)), shown / 12.92, vec3(lessThan(shown, vec3(0.04045))));
}
