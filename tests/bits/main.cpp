// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Prints the hash of every play after 20 s, with and without snapshots on the way. If the same line
// differs between two compilers, that is a fault.
#include "tests/bits/plays.hpp"

#include <cinttypes>
#include <cstdio>
#include <string>

int main()
{
    namespace bits = hapnet::bits;
    constexpr std::uint64_t ticks = 20'000;
    bool are_equal = true;
    for (const bits::Play& play : bits::plays()) {
        const auto hash = bits::hash_after(play, ticks);
        const auto over_snapshots = bits::hash_over_snapshots(play, ticks, 1000);
        are_equal = are_equal && hash == over_snapshots;
        std::printf("%-16s sleeping=%d %016" PRIx64 "%s\n", std::string{play.scene}.c_str(),
                    int{play.sleeping}, hash,
                    hash == over_snapshots ? "" : "  OTHER after snapshots");
        std::fflush(stdout);
    }
    return are_equal ? 0 : 1;
}
