// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// soak_session none|own|keys FIRST COUNT [DATAGRAMS] [--peers N|N-M [--troubled]]: plays the
// attacked sessions of the seeds FIRST .. FIRST + COUNT - 1, without keys, with keys of each side's
// own, or with a shared key as well, of two peers, N, or N to M in turn, and of more seeds until so
// many datagrams have reached their sides; with --troubled instead sessions without an attacker,
// one of whose peers is dead now and then. Prints every seed in which an invariant broke, and at
// the end what was played. Exits 0 when none did.
#include "tests/support/session/attacked_session.hpp"
#include "tests/support/session/troubled_group.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct Tally {
    std::uint64_t played = 0;
    std::uint64_t compared = 0;
    std::uint64_t broken = 0;
    std::uint64_t datagrams = 0;
    double work_5s_max_j = 0.0;
};

void report(const Tally& tally)
{
    fmt::print("  {} sessions, {} datagrams, {} broken; copies compared in {}; at most {:.4f} J "
               "into a hand within 5 s\n",
               tally.played, tally.datagrams, tally.broken, tally.compared, tally.work_5s_max_j);
    std::fflush(stdout);
}

/// How many peers play, and whether without an attacker.
struct Kind {
    std::size_t fewest = 2, most = 2;
    bool is_troubled = false;

    [[nodiscard]] bool is_known() const { return fewest >= 2 && fewest <= most && most <= 8; }
    [[nodiscard]] std::size_t peers_of(std::uint64_t seed) const
    {
        return fewest + seed % (most - fewest + 1);
    }
    /// The options that play this seed alone.
    [[nodiscard]] std::string options_of(std::uint64_t seed) const
    {
        if (most == 2 && !is_troubled) return "";
        return fmt::format(" --peers {}{}", peers_of(seed), is_troubled ? " --troubled" : "");
    }
};

/// What is judged of either kind of session.
hapnet::test::AttackedSession play(std::uint64_t seed, const Kind& kind, hapnet::test::Seal seal)
{
    const std::size_t peers = kind.peers_of(seed);
    if (!kind.is_troubled) return hapnet::test::play_attacked(seed, seal, peers);
    const auto group = hapnet::test::play_troubled_group(seed, peers, seal);
    return {.complaint = group.complaint, .datagrams = group.datagrams, .compared = group.compared};
}

/// What stands after --peers, and --troubled, taken out of the arguments.
Kind taken_kind(std::vector<std::string>& arguments)
{
    Kind kind;
    kind.is_troubled = std::erase(arguments, "--troubled") > 0;
    const auto option = std::ranges::find(arguments, "--peers");
    if (arguments.end() - option < 2) return kind;
    char* end = nullptr;
    kind.fewest = std::strtoull((option + 1)->c_str(), &end, 10);
    kind.most = *end == '-' ? std::strtoull(end + 1, &end, 10) : kind.fewest;
    if (*end != '\0') kind.most = 0;
    arguments.erase(option, option + 2);
    return kind;
}

std::optional<hapnet::test::Seal> seal_named(std::string_view name)
{
    using hapnet::test::Seal;
    for (const Seal seal : {Seal::none, Seal::own, Seal::keys}) {
        if (name == hapnet::test::name_of(seal)) return seal;
    }
    return std::nullopt;
}

} // namespace

int main(int argc, char** argv)
{
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const Kind kind = taken_kind(arguments);
    const auto seal = arguments.empty() ? std::nullopt : seal_named(arguments[0]);
    if (!seal || arguments.size() < 3 || arguments.size() > 4 || !kind.is_known()) {
        fmt::print(stderr,
                   "usage: soak_session none|own|keys FIRST COUNT [DATAGRAMS] [--peers N|N-M "
                   "[--troubled]]\n");
        return 2;
    }
    const auto number = [&](std::size_t index) {
        return index < arguments.size() ? std::strtoull(arguments[index].c_str(), nullptr, 10) : 0;
    };
    constexpr std::uint64_t often = 100;
    Tally tally;
    for (std::uint64_t seed = number(1); tally.played < number(2) || tally.datagrams < number(3);
         ++seed) {
        const auto session = play(seed, kind, *seal);
        ++tally.played;
        tally.compared += session.compared ? 1 : 0;
        tally.datagrams += session.datagrams;
        tally.work_5s_max_j = std::max(tally.work_5s_max_j, session.work_5s_max_j);
        if (session.complaint) {
            ++tally.broken;
            fmt::print("  seed {}: {} (repeat it: build/release/bin/soak_session {} {} 1{})\n",
                       seed, *session.complaint, arguments[0], seed, kind.options_of(seed));
        }
        if (tally.played % often == 0) report(tally);
    }
    report(tally);
    return tally.broken == 0 ? 0 : 1;
}
