// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// spin_session ALGORITHM PLAYERS SECONDS: sessions in virtual time at 160 ms without keys. Two play
// P1 in the paper's scene; more carry its cube (T7). ALGORITHM is a name or a shared object.
#include "lab/virtual_time/play.hpp"
#include "peer/shared_object/load.hpp"
#include "scene/text/text.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv)
{
    using namespace hapnet;
    using namespace std::chrono_literals;
    if (argc != 4) return 2;
    const auto algorithm = peer::shared_object::load_from_disk(argv[1]);
    if (!algorithm) std::fprintf(stderr, "%s\n", algorithm.error().message.c_str());
    const auto players = static_cast<std::size_t>(std::atol(argv[2]));
    if (!algorithm || players < 2) return 2;
    lab::virtual_time::Setting setting;
    setting.task = players == 2 ? device::Task::p1 : device::Task::t7;
    const auto no_file = [](const std::string& file) { return base::fail(file); };
    const auto scene = scene::load_scene(std::string{device::scene_of(setting.task)}, no_file);
    if (!scene) return 2;
    setting.scene = *scene;
    setting.length = std::chrono::seconds{std::atol(argv[3])};
    setting.profile.path.up.delay = emulator::constant(160ms);
    setting.profile.path.down.delay = emulator::constant(160ms);
    setting.players.assign(players, {.algorithm = *algorithm});
    const auto trace = lab::virtual_time::play(setting);
    return trace && trace->overlap > 0.9 ? 0 : 1;
}
