#!/usr/bin/env bash
# Draws the pictures of the documents, docs/images/*.png, with the tool of build/release (see demo.sh).
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

shlight=$PWD/build/release/bin/shlight
images=$PWD/docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$images"

# side_by_side FILE PICTURE…
side_by_side() {
  local file=$1
  shift
  oiiotool "$@" --mosaic:pad=8 "$#x1" -o "$file"
}

"$shlight" render builtin:scene --camera 30,7,1.15 --exposure 0.6 --size 960x540 -o "$images/hero.png"

for bands in 1 2 3 5 9; do
  "$shlight" render builtin:sphere --light builtin:thesis --bands "$bands" --camera 100,20 --size 240x240 \
    -o "$work/bands_$bands.png"
done
side_by_side "$images/bands.png" "$work"/bands_{1,2,3,5,9}.png

"$shlight" render builtin:scene --light builtin:sky:elevation=8,azimuth=-110,turbidity=3 --camera 30,10,1.1 \
  --exposure 0.4 --size 300x240 -o "$work/evening.png"
for light in sky studio axes; do
  "$shlight" render builtin:scene --light "builtin:$light" --camera 30,10,1.1 --exposure 0.4 --size 300x240 \
    -o "$work/$light.png"
done
side_by_side "$images/lights.png" "$work"/{sky,evening,studio,axes}.png

# A low sun over a dark ground rings: before and after, negative light striped.
for window in none auto; do
  for model in sphere knot; do
    "$shlight" render "builtin:$model" --light builtin:sky:elevation=20,azimuth=-60,turbidity=2.5,ground=0 \
      --window "$window" --mark-negative --camera 60,-35 --exposure 1 --size 300x300 -o "$work/ringing_${model}_$window.png"
  done
done
side_by_side "$images/ringing.png" "$work"/ringing_{sphere,knot}_none.png "$work"/ringing_{sphere,knot}_auto.png

# One light in every layout, each beside the sphere that it lights: all spheres are alike.
globe="fn:r=(0.2+0.8*max(0,x)+0.5*max(0,z))*(abs(sin(6*asin(y)))*abs(sin(6*atan2(x,-z)))*sqrt(1-y*y)>0.06?1:0.3)"
globe+="+6*max(0,0.5*x+0.62*y-0.6*z)^12;"
globe+="g=(0.2+0.8*max(0,y)+0.4*max(0,x))*(abs(sin(6*asin(y)))*abs(sin(6*atan2(x,-z)))*sqrt(1-y*y)>0.06?1:0.3)"
globe+="+5*max(0,0.5*x+0.62*y-0.6*z)^12;"
globe+="b=(0.2+0.8*max(0,-z)+0.5*max(0,-x))*(abs(sin(6*asin(y)))*abs(sin(6*atan2(x,-z)))*sqrt(1-y*y)>0.06?1:0.3)"
globe+="+3.2*max(0,0.5*x+0.62*y-0.6*z)^12"
mkdir -p "$images/layouts"
while read -r layout size; do
  "$shlight" convert-map "$globe" --layout "$layout" --size "$size" -o "$work/$layout.exr"
  light=$work/$layout.exr
  if [[ $layout == cube ]]; then
    light=$work/cube_px.exr
    oiiotool "$work"/cube_{px,nx,py,ny,pz,nz}.exr --mosaic:pad=8 3x2 -o "$work/cube.exr"
  fi
  "$shlight" render builtin:sphere --light "$light" --layout "$layout" --camera 200,15 --size 200x200 \
    -o "$work/sphere.png"
  oiiotool "$work/$layout.exr" --mulc 0.5 --colorconvert linear sRGB --clamp:min=0:max=1 --fit:pad=1 300x200 \
    "$work/sphere.png" --ch R,G,B --mosaic:pad=8 2x1 -o "$images/layouts/$layout.png"
done <<'END'
lat-long 600
angular-map 400
mirror-ball 400
cube 140
vertical-cross 100
horizontal-cross 100
horizontal-strip 100
vertical-strip 100
octahedral 400
openexr-lat-long 600
openexr-cube 100
END
ls -l "$images" "$images/layouts"
