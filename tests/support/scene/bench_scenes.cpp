// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/bench_scenes.hpp"

#include "proto/base/ensure.hpp"
#include "scene/text/text.hpp"

#include <fstream>
#include <sstream>

namespace hapnet::test {

scene::Description bench_scene(const std::string& name)
{
    std::ifstream file{std::string{HAPNET_BENCH_SCENES} + "/" + name + ".toml"};
    base::ensure(file.is_open());
    std::stringstream text;
    text << file.rdbuf();
    return scene::parse_scene(text.str(), name).value();
}

} // namespace hapnet::test
