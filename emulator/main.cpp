// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/dry_run.hpp"
#include "emulator/emulate.hpp"
#include "emulator/verify_command.hpp"

#include <cstddef>
#include <span>
#include <string_view>

int main(int argc, char** argv)
{
    using namespace hapnet::emulator;
    const std::span words{argv, static_cast<std::size_t>(argc)};
    const std::string_view first = words.size() > 1 ? words[1] : "";
    if (first == "check") return check_command(words.subspan(1));
    if (first == "predict") return predict_command(words.subspan(1));
    if (first == "verify") return verify_program(words.subspan(1));
    return emulate(words);
}
