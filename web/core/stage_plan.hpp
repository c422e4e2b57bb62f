// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::web {

/// A choice of what the stage plays.
struct Choice {
    std::string mode = "live";
    std::string task = "P1";
    std::string algorithm = "base";
    std::string scene = "task"; // the task's own, or a built-in scene
    std::string preset = "paper-delay-160";
    std::string device = "simulated"; // device of A; other peers simulate theirs
    int peers = 2;
    int seconds = 30;
    std::int64_t seed = 1;
    bool loop = true;

    friend bool operator==(const Choice&, const Choice&) = default;
    [[nodiscard]] nlohmann::ordered_json json() const;
};

/// A choice to start from, and what there is to see in it.
struct Story {
    std::string name; // name in requests
    std::string title;
    std::string look; // a sentence: where to look, and what happens there
    Choice choice;

    [[nodiscard]] nlohmann::ordered_json json() const;
};

/// The sets that a page may choose from. No other text of a page reaches a command line.
struct Choices {
    std::vector<std::string> modes{"live", "virtual"};
    std::vector<std::string> scenes; // the task's own scene first
    std::vector<Story> stories;
    std::vector<std::string> tasks;
    std::vector<std::string> algorithms;
    std::vector<std::string> presets;
    std::vector<std::string> devices{"simulated", "page"}; // devices for A
    int peers_min = 2;
    int peers_max = 8;
    int seconds_min = 5;
    int seconds_max = 600;

    [[nodiscard]] nlohmann::ordered_json json() const;
};

/// Returns the description of a profile: the first sentence of its comments, at most 160 bytes of
/// it.
[[nodiscard]] std::string about_profile(std::string_view text);

/// The sets of this version.
[[nodiscard]] Choices all_choices(std::vector<std::string> presets);

/// `before`, or the story that the request names in its mode and loop, with what the request says
/// instead. The error names what is wrong and what would be right. Members that are not known are
/// refused, "do" apart.
[[nodiscard]] base::Result<Choice> choice_of(const nlohmann::ordered_json& request,
                                             const Choice& before, const Choices& choices);

/// The folders of a run.
struct StageFolders {
    std::string programs; // holds hapnet-emulator and hapnet-peer
    std::string sockets;  // for control sockets; mode 0700
    std::string results;  // for the results of this run
    std::string kept;     // for the last seconds that the daemons keep in memory
};

/// The words of a command, the program first; and the control socket that it makes.
struct Start {
    std::vector<std::string> words;
    std::string socket;
    std::string log; // file for its output
};

/// The emulator of a choice: one path of two peers, a link for every two of more.
[[nodiscard]] Start emulator_start(const Choice& choice, const StageFolders& folders);

/// The places to which peers send. "1-2" is the place to which peer 1 sends to reach peer 2. They
/// are read from the line that the emulator prints when it is ready. The error says that the line
/// is another one.
using Places = std::map<std::string, std::string, std::less<>>;
[[nodiscard]] base::Result<Places> places_in(std::string_view ready_line, int peers);

/// A session in virtual time instead of an emulator and peers: with the other algorithms beside
/// the chosen one, where two play.
[[nodiscard]] Start lab_start(const Choice& choice, const StageFolders& folders,
                              const Choices& choices);
/// The sockets of its peers.
[[nodiscard]] std::vector<std::string> lab_peer_sockets(const std::string& socket, int peers);

/// A peer, 1 to choice.peers; never with a real device. `places` is of places_in().
[[nodiscard]] Start peer_start(int id, const Choice& choice, const StageFolders& folders,
                               const Places& places);

} // namespace hapnet::web
