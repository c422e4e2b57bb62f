# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Makes the wheel of the Python module, for scripts/package.sh and the wheel's test. To be sourced.

# make_wheel REPOSITORY DIR: leaves DIR/hapnet-VERSION-py3-none-any.whl. Debian's Python makes it
# without a network, of a copy in DIR/python, because setuptools writes beside its sources.
make_wheel() {
    rm -rf "$2/python" "$2"/hapnet-*.whl
    mkdir -p "$2/python"
    cp -r "$1/python/hapnet" "$1/python/pyproject.toml" "$2/python"
    /usr/bin/python3 -m pip --quiet --no-cache-dir --disable-pip-version-check wheel --no-index \
        --no-deps --no-build-isolation --wheel-dir "$2" "$2/python"
}
