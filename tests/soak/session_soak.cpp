// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// soak_session none|keys FIRST COUNT [DATAGRAMS]: plays the attacked sessions of the seeds FIRST ..
// FIRST + COUNT - 1, without or with keys, and of more seeds until so many datagrams have reached
// their sides. Prints every seed in which an invariant broke, and at the end what was played. Exits
// 0 when none did.
#include "tests/support/session/attacked_session.hpp"

#include <algorithm>
#include <cstdlib>
#include <spdlog/fmt/fmt.h>
#include <string>
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

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool keys = !arguments.empty() && arguments[0] == "keys";
    if (arguments.size() < 3 || arguments.size() > 4 || (!keys && arguments[0] != "none")) {
        fmt::print(stderr, "usage: soak_session none|keys FIRST COUNT [DATAGRAMS]\n");
        return 2;
    }
    const auto seal = keys ? hapnet::test::Seal::keys : hapnet::test::Seal::none;
    const auto number = [&](std::size_t index) {
        return index < arguments.size() ? std::strtoull(arguments[index].c_str(), nullptr, 10) : 0;
    };
    constexpr std::uint64_t often = 100;
    Tally tally;
    for (std::uint64_t seed = number(1); tally.played < number(2) || tally.datagrams < number(3);
         ++seed) {
        const auto session = hapnet::test::play_attacked(seed, seal);
        ++tally.played;
        tally.compared += session.compared ? 1 : 0;
        tally.datagrams += session.datagrams;
        tally.work_5s_max_j = std::max(tally.work_5s_max_j, session.work_5s_max_j);
        if (session.complaint) {
            ++tally.broken;
            fmt::print("  seed {}: {} (repeat it: build/release/bin/soak_session {} {} 1)\n", seed,
                       *session.complaint, arguments[0], seed);
        }
        if (tally.played % often == 0) report(tally);
    }
    report(tally);
    return tally.broken == 0 ? 0 : 1;
}
