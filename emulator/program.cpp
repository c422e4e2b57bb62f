// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/program.hpp"

#include "emulator/commands.hpp"

#include <cstddef>
#include <span>
#include <variant>

namespace hapnet::emulator {

namespace {

base::Result<int> execute(const AnyOptions& chosen)
{
    return std::visit([](const auto& options) { return run(options); }, chosen);
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program("hapnet-emulator", parse_command_line(words), execute);
}

} // namespace hapnet::emulator
