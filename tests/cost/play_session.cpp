// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// play_session ALGORITHM SECONDS: T1 in virtual time under 20 ms.
#include "emulator/core/profile/text.hpp"
#include "lab/virtual_time/play.hpp"
#include "peer/shared_object/load.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv)
{
    using namespace hapnet;
    if (argc != 3) return 2;
    const auto algorithm = peer::shared_object::load_from_disk(argv[1]);
    if (!algorithm) {
        std::fprintf(stderr, "%s\n", algorithm.error().message.c_str());
        return 2;
    }
    lab::virtual_time::Setting setting;
    setting.task = device::Task::t1;
    setting.length = std::chrono::seconds{std::atol(argv[2])};
    setting.profile = emulator::parse_profile("both.delay = \"20ms\"", "here", {}).value();
    for (auto& player : setting.players) player.algorithm = *algorithm;
    const auto trace = lab::virtual_time::play(setting);
    return trace && !trace->sides[0].empty() ? 0 : 1;
}
