#!/usr/bin/env bash
# Builds everything and runs every test: test.sh [dev|release|asan|tsan]. For a fresh Debian 12; needs root or sudo
# only where packages are missing.
#
# The default is dev, not the demo's release: assertions are part of what is tested, and release has none. That costs
# one more build of the library where both are run, about two minutes on two cores.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

preset=${1:-dev}
install_packages
build "$preset"
say "Testing build/$preset"
ctest --preset "$preset" --output-on-failure --parallel "$(nproc)"
