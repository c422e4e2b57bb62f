// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/loss.hpp"
#include "emulator/tools/verify/properties.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <variant>
#include <vector>

// The law of docs/design/add-a-loss-law.md, through the templates that the laws of the emulator go
// through. In the emulator its first part would be emulator/core/loss/growing_gap.{hpp,cpp}.

namespace hapnet::emulator {

// ---- growing_gap.hpp

/// Single losses with a growing distance: the first after `first` datagrams that pass, each further
/// one after `growth` more than the one before. first + growth > 0.
struct GrowingGap {
    std::uint32_t first = 0;
    std::uint32_t growth = 1;

    static constexpr DropCause cause = DropCause::periodic_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals& arrivals) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts& facts) const;

    friend bool operator==(const GrowingGap&, const GrowingGap&) = default;
};

constexpr auto fields_of(base::Tag<GrowingGap>)
{
    return base::fields(
        "growing-gap",
        base::field("first", &GrowingGap::first, "datagrams that pass before the first loss"),
        base::field("growth", &GrowingGap::growth, "by which each further gap is longer"));
}

/// Keeps the number of the next loss. New numbers hold from that loss on.
class GrowingGap::Model {
public:
    Model(const GrowingGap& law, const base::RandomStream&)
        : law_{law}, next_{law.first}, gap_{law.first}
    {}

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&)
    {
        if (packet.number < next_) return false;
        gap_ += law_.growth;
        next_ = packet.number + gap_ + 1;
        return true;
    }
    void change(const GrowingGap& law, const base::RandomStream&) { law_ = law; }

private:
    GrowingGap law_;
    std::uint64_t next_; // lost
    std::uint64_t gap_;  // datagrams that pass before it
};

// ---- growing_gap.cpp

base::Result<void> GrowingGap::validate() const
{
    if (first > 0 || growth > 0) return {};
    return base::fail("everything would be lost: write first or growth above 0");
}

LossTheory GrowingGap::theory(const Arrivals& arrivals) const
{
    double losses = 0.0;
    std::uint64_t gap = first;
    for (std::uint64_t number = gap; number < arrivals.count; number += gap + 1) {
        losses += 1.0;
        gap += growth;
    }
    // No loss follows another: the gap after each is at least 1.
    return theory_from_counts(static_cast<double>(arrivals.count), losses, losses);
}

std::vector<LossProperty> GrowingGap::properties(const RunFacts& facts) const
{
    return {same_losses(*this, facts.count)};
}

// ---- loss.hpp: one more line in the variant. Here it has the law and one other.

static_assert(LawOfLoss<GrowingGap>);
using ExampleLaws = std::variant<RandomLoss, GrowingGap>;
using ExampleProcess = LossProcessOf<ExampleLaws>;

namespace {

std::vector<std::uint8_t> example_losses(const GrowingGap& law, std::uint64_t count)
{
    ExampleProcess process{law, base::Seed{42}.stream("up/loss/growing-gap")};
    std::vector<std::uint8_t> lost;
    for (std::uint64_t number = 0; number < count; ++number) {
        lost.push_back(process.on_packet({.number = number}) ? 1 : 0);
    }
    return lost;
}

} // namespace

// ---- growing_gap_test.cpp

TEST(GrowingGap, LosesOneDatagramAfterEachLongerGap)
{
    EXPECT_EQ(fmt::format("{}", fmt::join(example_losses({2, 1}, 15), "")), "001000100001000");
}

TEST(GrowingGap, SaysWhyADatagramWasLostAndHasNoState)
{
    ExampleProcess process{GrowingGap{0, 1}, base::Seed{42}.stream("up/loss/growing-gap")};
    EXPECT_EQ(process.on_packet({.number = 0}), DropCause::periodic_loss);
    EXPECT_EQ(process.state(), LossState::none);
}

TEST(GrowingGap, GoesOnFromItsGapWhenItsNumbersChange)
{
    ExampleProcess process{GrowingGap{2, 1}, base::Seed{42}.stream("up/loss/growing-gap")};
    std::string text;
    for (std::uint64_t number = 0; number < 15; ++number) {
        if (number == 3) process.change(GrowingGap{2, 0});
        text += process.on_packet({.number = number}) ? '1' : '0';
    }
    EXPECT_EQ(text, "001000100010001");
}

TEST(GrowingGap, LosesWhatItsTheoryStates)
{
    constexpr std::uint64_t count = 10'000;
    double sum = 0.0;
    for (const auto one : example_losses({3, 2}, count)) sum += one;
    EXPECT_DOUBLE_EQ((GrowingGap{3, 2}.theory({.count = count}).share), sum / count);
}

TEST(GrowingGap, IsVerifiedByThePropertiesThatItStates)
{
    const GrowingGap law{3, 2};
    auto lost = example_losses(law, 1000);
    const auto verify = [&] {
        return tools::verify_properties(law.properties({.count = lost.size()}), lost, {}, 1e-6);
    };
    ASSERT_EQ(verify().size(), 1U);
    EXPECT_EQ(verify()[0].outcome, tools::Outcome::passed);
    lost[500] ^= 1U;
    EXPECT_EQ(verify()[0].outcome, tools::Outcome::failed);
}

TEST(GrowingGap, SaysWhatIsImpossible)
{
    EXPECT_TRUE((GrowingGap{1, 0}.validate()));
    EXPECT_EQ((GrowingGap{0, 0}.validate().error().message),
              "everything would be lost: write first or growth above 0");
}

} // namespace hapnet::emulator
