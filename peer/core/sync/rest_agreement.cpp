// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/rest_agreement.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

constexpr double still_m = 1e-7;   // a body that has gone less than this rests
constexpr double rounded_m = 1e-6; // bound of a message's rounding and `still_m` together

bool are_apart(base::Position a, base::Position b, double by_m) { return base::norm(a - b) > by_m; }

bool is_touched(const scene::World& world)
{
    for (std::uint32_t hand = 0; hand < world.state().hands.size(); ++hand)
        if (world.touch(hand).touching) return true;
    return false;
}

} // namespace

bool RestAgreement::play(std::int64_t tick, const scene::World& world, scene::BodyId body)
{
    own_.until = tick;
    const base::Position place = world.position(body);
    const bool touched = is_touched(world);
    if (touched || are_apart(place, own_.place, still_m)) {
        own_.place = place;
        own_.since = tick;
        others_.reset();
    }
    return touched;
}

void RestAgreement::hear(const Word& word)
{
    const bool is_told_all = word.knows >= own_.since;
    if (!is_told_all || from_ != word.from || !others_ ||
        are_apart(word.body, others_->place, still_m)) {
        from_ = word.from;
        others_.reset();
        if (is_told_all) others_ = Rest{.place = word.body, .since = word.tick};
    }
    if (others_) others_->until = word.tick;
}

std::optional<base::Displacement> RestAgreement::take_way(std::int64_t rest)
{
    if (!others_) return std::nullopt;
    const std::int64_t rested =
        std::min(own_.until, others_->until) - std::max(own_.since, others_->since);
    if (rested < rest || !are_apart(others_->place, own_.place, rounded_m)) return std::nullopt;
    const base::Displacement way = others_->place - own_.place;
    own_.place = others_->place;
    own_.since = own_.until;
    others_.reset();
    return way;
}

std::optional<std::size_t> yields_to(const Situation& situation)
{
    if (!situation.yields || situation.remote.freshness() <= 0.0) return std::nullopt;
    for (std::size_t i = 0; i < situation.others.size(); ++i)
        if (&situation.others[i] == &situation.remote) return i;
    return std::nullopt;
}

} // namespace hapnet::peer
