// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/fates/fates.hpp"

#include "proto/base/random.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

/// Draws one value after the other.
class Draws {
public:
    Draws(std::string_view name, std::uint64_t round)
        : stream_{base::Seed{1}.stream(name)}, round_{round}
    {}

    std::uint32_t below(std::uint32_t bound)
    {
        return static_cast<std::uint32_t>(stream_.below(bound, round_, draw_++));
    }
    /// Draws small and large times equally often.
    base::Duration time()
    {
        const auto bits = stream_.bits(round_, draw_++) >> below(64);
        return base::Duration{static_cast<base::Duration::rep>(
            bits % (static_cast<std::uint64_t>(fate_time_max.count()) + 1))};
    }

private:
    base::RandomStream stream_;
    std::uint64_t round_;
    std::uint32_t draw_ = 0;
};

Fate random_fate(Draws& draws)
{
    Fate fate{.drop = drop_causes[draws.below(drop_causes.size())]};
    const auto states = draws.below(loss_laws_max + 1);
    for (std::uint32_t i = 0; i < states; ++i)
        fate.states[i] = static_cast<LossState>(draws.below(7));
    if (draws.below(3) == 0) return fate;
    fate.drop.reset();
    fate.delay = draws.time();
    if (draws.below(3) == 0) fate.copy_after = draws.time();
    fate.flips.count = static_cast<std::uint8_t>(draws.below(Flips::most + 1));
    for (std::uint32_t i = 0; i < fate.flips.count; ++i) {
        fate.flips.places[i] = draws.below(0xffff'ffff) >> draws.below(32);
    }
    if (draws.below(3) == 0) fate.displacement.places = draws.below(1000);
    if (draws.below(3) == 0) fate.displacement.time = draws.time();
    return fate;
}

Fates random_fates(std::uint64_t round)
{
    Draws draws{"fates", round};
    Fates fates;
    for (auto count = draws.below(4); count > 0; --count) fates.up.push_back(random_fate(draws));
    for (auto count = draws.below(4); count > 0; --count) fates.down.push_back(random_fate(draws));
    return fates;
}

TEST(FatesCodec, GivesBackAllFates)
{
    for (std::uint64_t round = 0; round < 5'000; ++round) {
        const Fates fates = random_fates(round);
        const auto again = parse_fates(to_text(fates));
        ASSERT_TRUE(again) << again.error().message << ", round " << round;
        ASSERT_EQ(*again, fates) << "round " << round;
    }
}

TEST(FatesCodec, AcceptsOnlyTextThatItWouldWriteItselfAfterOneCharacterOfItChanged)
{
    constexpr std::string_view characters = "0123456789,/|\nudmt-";
    int accepted = 0;
    for (std::uint64_t round = 0; round < 20'000; ++round) {
        std::string text = to_text(random_fates(round));
        Draws draws{"mutation", round};
        const auto first = static_cast<std::uint32_t>(fates_header.size());
        const auto at = first + draws.below(static_cast<std::uint32_t>(text.size()) - first);
        text[at] = characters[draws.below(characters.size())];
        const auto fates = parse_fates(text);
        if (!fates) continue;
        ++accepted;
        ASSERT_EQ(to_text(*fates), text) << "round " << round;
    }
    EXPECT_GT(accepted, 1'000);
    EXPECT_LT(accepted, 19'000);
}

} // namespace
} // namespace hapnet::emulator
