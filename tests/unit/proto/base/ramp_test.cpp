// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/ramp.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace ramp_test {

using namespace std::chrono_literals;

enum class Gait : std::uint8_t { walk, trot };
constexpr auto names_of(Tag<Gait>) { return names("walk", "trot"); }

struct Rider {
    double mass_kg = 70.0;
    std::optional<Duration> reaction{};

    friend bool operator==(const Rider&, const Rider&) = default;
};
constexpr auto fields_of(Tag<Rider>)
{
    return fields("rider", member("mass", &Rider::mass_kg), member("reaction", &Rider::reaction));
}

struct Saddle {
    std::uint32_t straps = 2;
};
constexpr auto fields_of(Tag<Saddle>)
{
    return fields("saddle", member("straps", &Saddle::straps));
}

namespace {

TEST(Ramp, HasAValueBetweenTwoWhereAllFieldsHave)
{
    EXPECT_EQ(between(Rider{60.0, 100ms}, Rider{80.0, 200ms}, 0.25), (Rider{65.0, 125ms}));
    EXPECT_EQ(between(Rider{60.0, 100ms}, Rider{80.0, std::nullopt}, 0.25), std::nullopt);
    EXPECT_EQ(between(Saddle{1}, Saddle{4}, 0.5)->straps, 3U); // 2.5 rounds away from zero
    EXPECT_EQ(between(Gait::walk, Gait::trot, 0.5), std::nullopt);
}

} // namespace
} // namespace ramp_test
} // namespace hapnet::base
