#!/usr/bin/env bash
# Builds the tool and draws the built-in scene under the built-in light into demo/. For a fresh Debian 12; needs root
# or sudo only where packages are missing.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages
build release shlight
say "Drawing"
build/release/bin/shlight demo -o demo/
say "The pictures are in $PWD/demo:"
find demo -maxdepth 1 -type f | sort
