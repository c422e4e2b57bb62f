// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/emulate.hpp"
#include "emulator/verify_command.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace hapnet::emulator {

namespace {

/// The dry runs, each with a command line of its own that begins with its name.
struct Subcommand {
    std::string_view name;
    int (*run)(std::span<char*> words);
};
constexpr std::array subcommands{Subcommand{"verify", verify_program}};

} // namespace

int main_program(std::span<char*> words)
{
    for (const auto& [name, run_it] : subcommands) {
        if (words.size() > 1 && words[1] == name) return run_it(words.subspan(1));
    }
    return emulate(words);
}

} // namespace hapnet::emulator

int main(int argc, char** argv)
{
    return hapnet::emulator::main_program({argv, static_cast<std::size_t>(argc)});
}
