// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/requirements.hpp"
#include "scene/text/text.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>
#include <tuple>

/// A scene that is accepted passes its check, has a tick, and prints as text that reads back as
/// the same scene.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto scene = scene::parse_scene(text, "fuzz");
    if (!scene) return 0;
    base::ensure(scene::check(*scene).has_value());
    std::ignore =
        scene::cheapest_stepper(scene::required_features(scene::requirements_of(*scene, true)));
    if (scene->bodies.size() > 64) return 0; // printed, it says the same at length
    const auto printed = scene::to_text(*scene);
    const auto again = scene::parse_scene(printed, "printed");
    base::ensure(again.has_value());
    base::ensure(*again == *scene);
    base::ensure(scene::to_text(*again) == printed);
    return 0;
}
