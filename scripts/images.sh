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
ls -l "$images"
