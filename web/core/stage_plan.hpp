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

/// A choice to start from, and a description of what there is to see.
struct Story {
    std::string name; // name in requests
    std::string title;
    std::string look; // a sentence: where to look, and what happens there
    Choice choice;

    [[nodiscard]] nlohmann::ordered_json json() const;
};

/// The sets of values from which a page may choose. No other text of a page reaches a command line.
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

/// Returns the description of a profile: the first sentence of its comments, at most 160 bytes.
[[nodiscard]] std::string about_profile(std::string_view text);

/// Returns the sets of this version.
[[nodiscard]] Choices all_choices(std::vector<std::string> presets);

/// Returns a choice with the values of the request. Values that the request does not have come from
/// the story that it names, with the mode and loop of `before`, or else from `before`. The error
/// names what is wrong and what would be right. Unknown members except "do" are refused.
[[nodiscard]] base::Result<Choice> choice_of(const nlohmann::ordered_json& request,
                                             const Choice& before, const Choices& choices);

/// The folders of a run.
struct StageFolders {
    std::string programs; // holds hapnet-emulator and hapnet-peer
    std::string sockets;  // for control sockets; mode 0700
    std::string results;  // for the results of this run
    std::string kept;     // for the last seconds that the daemons keep in memory
};

/// A command: its words, the program first, and the control socket that it makes.
struct Start {
    std::vector<std::string> words;
    std::string socket;
    std::string log; // file for its output
};

/// Returns the command for the emulator of a choice: one path for two peers, or a link between
/// every two of more peers.
[[nodiscard]] Start emulator_start(const Choice& choice, const StageFolders& folders);

/// The places to which peers send. "1-2" is the place to which peer 1 sends to reach peer 2. They
/// are read from the line that the emulator prints when it is ready. The error says that it is
/// another line.
using Places = std::map<std::string, std::string, std::less<>>;
[[nodiscard]] base::Result<Places> places_in(std::string_view ready_line, int peers);

/// Returns the command for a session in virtual time instead of an emulator and peers. With two
/// peers, the other algorithms play in parallel with the chosen one.
[[nodiscard]] Start lab_start(const Choice& choice, const StageFolders& folders,
                              const Choices& choices);
/// Returns the sockets of the session's peers.
[[nodiscard]] std::vector<std::string> lab_peer_sockets(const std::string& socket, int peers);

/// Returns the command for a peer, 1 to choice.peers. It never uses a real device. `places` comes
/// from places_in().
[[nodiscard]] Start peer_start(int id, const Choice& choice, const StageFolders& folders,
                               const Places& places);

} // namespace hapnet::web
