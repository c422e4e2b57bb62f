// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"
#include "proto/secure/primitives.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace hapnet::peer {

/// The command `hapnet-peer keygen --peers N [--name NAME] --out DIR`, which makes the files of a
/// whole circle.
struct KeygenCircleCommand {
    std::uint8_t peers = 2;
    std::string name = "lab";
    std::string folder;
};

/// The command `hapnet-peer keygen --own --id ID [--name NAME] --out FILE`, which makes one host's
/// file, so that no secret has to be transferred.
struct KeygenOwnCommand {
    std::uint8_t id = 1;
    std::string name = "lab";
    std::string file;
};

/// The command `hapnet-peer key show FILE`.
struct KeyShowCommand {
    std::string file;
};

/// The command `hapnet-peer key add FILE --id ID --public KEY [--endpoint HOST:PORT] [--make-shared
/// FILE | --shared FILE]`.
struct KeyAddCommand {
    std::string file;
    std::uint8_t id = 0;
    secure::PublicKey key{};
    std::string endpoint;
    std::string make_shared; // file to write a new shared key to, for the other host
    std::string shared;      // file with the shared key that the other host has made
};

using KeyCommand =
    std::variant<KeygenCircleCommand, KeygenOwnCommand, KeyShowCommand, KeyAddCommand>;

/// Adds the commands about keys to a program, and returns the chosen one after parsing.
class KeyCommands {
public:
    explicit KeyCommands(cli::Command& program);
    KeyCommands(const KeyCommands&) = delete;
    KeyCommands& operator=(const KeyCommands&) = delete;
    ~KeyCommands() = default;

    [[nodiscard]] bool is_chosen() const;
    /// Returns the chosen command, or an error if its options contradict each other.
    [[nodiscard]] base::Result<KeyCommand> chosen() const;

private:
    void add_keygen(cli::Command& program);
    void add_key(cli::Command& program);
    [[nodiscard]] base::Result<KeyCommand> keygen() const;

    cli::Command* keygen_ = nullptr;
    cli::Command* key_ = nullptr;
    std::optional<std::uint8_t> peers_, id_;
    bool own_ = false;
    std::string name_ = "lab";
    std::string out_;
    std::string action_, file_;
    KeyAddCommand adding_;
};

// Functions that run the commands. Each returns its exit code.

[[nodiscard]] base::Result<int> run(const KeygenCircleCommand& command);
[[nodiscard]] base::Result<int> run(const KeygenOwnCommand& command);
[[nodiscard]] base::Result<int> run(const KeyShowCommand& command);
[[nodiscard]] base::Result<int> run(const KeyAddCommand& command);

} // namespace hapnet::peer
