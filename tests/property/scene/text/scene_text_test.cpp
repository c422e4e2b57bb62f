// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/quantity.hpp"
#include "scene/text/text.hpp"
#include "tests/property/scene/text/random_scene.hpp"

#include <bit>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

TEST(SceneText, EveryPrintedSceneReadsBackAsItself)
{
    RandomScene random{1};
    for (int i = 0; i < 1'000; ++i) {
        const Description scene = random.description();
        ASSERT_TRUE(check(scene)) << check(scene).error().message;
        const auto text = to_text(scene);
        const auto read = parse_scene(text, "printed");
        ASSERT_TRUE(read) << read.error().message << "\n" << text;
        ASSERT_TRUE(*read == scene) << text << "\nreads as\n" << to_text(*read);
        ASSERT_EQ(to_text(*read), text); // the sign of zeros is kept
        ASSERT_EQ(hash(*read), hash(scene));
    }
}

TEST(SceneText, EveryPrintedQuantityReadsBackAsTheSameBits)
{
    const auto stream = base::Seed{1}.stream("quantities");
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const auto value = std::bit_cast<double>(stream.bits(i));
        if (!std::isfinite(value)) continue;
        for (const base::QuantityKind* kind :
             {&base::length_kind, &base::mass_kind, &base::stiffness_kind}) {
            const auto text = base::quantity_text(value, *kind);
            const auto read = base::parse_quantity(text, *kind);
            ASSERT_TRUE(read) << text;
            ASSERT_EQ(std::bit_cast<std::uint64_t>(*read), stream.bits(i)) << text;
        }
    }
}

} // namespace
} // namespace hapnet::scene
