#!/usr/bin/env bash
# Draws baked transfer, docs/images/transfer*.png: cosine, shadowed and interreflected beside each other, under two
# lights. Of builtin:scene; where SHLIGHT_TEST_DATA names a folder with them, also of the DirectX SDK's skull and of
# Stanford's bunny, whose picture is not committed since its terms ask for permission.
# transfer_images.sh [TOOL] [FOLDER], otherwise the tool of build/release (see demo.sh) and docs/images.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

shlight=${1:-$PWD/build/release/bin/shlight}
images=${2:-$PWD/docs/images}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$images"
font=$(fc-match --format '%{file}' sans)

# sheet FILE MODEL CAMERA
sheet() {
  local file=$1 model=$2 camera=$3 kind light tiles=()
  for kind in cosine shadowed interreflected; do
    "$shlight" bake "$model" --transfer "$kind" --bands 5 -o "$work/$kind.glb"
  done
  for light in sky:elevation=25 studio; do
    for kind in cosine shadowed interreflected; do
      local tile=$work/${kind}_${light%%:*}.png
      "$shlight" render "$work/$kind.glb" --method transfer --light "builtin:$light" --window auto-radiance \
        --camera "$camera" --exposure 0.4 --size 480x320 -o "$tile"
      oiiotool "$tile" --text:x=12:y=28:size=17:color=1,1,1:font="$font" "$kind, $light" -o "$tile"
      tiles+=("$tile")
    done
  done
  oiiotool "${tiles[@]}" --mosaic:pad=8 3x2 -o "$file"
}

sheet "$images/transfer.png" builtin:scene 75,20,1.4
if [[ -n ${SHLIGHT_TEST_DATA:-} ]]; then
  sheet "$images/transfer_models.png" "$SHLIGHT_TEST_DATA/models/dx_skullocc.x" 30,5,1.1
  sheet "$images/transfer_bunny.png" "$SHLIGHT_TEST_DATA/models/bun_zipper.ply" 30,15,1.1
fi
