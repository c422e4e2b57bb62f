// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/program.hpp"
#include "proto/net/standard_streams.hpp"

#include <cstddef>

int main(int argc, char** argv)
{
    hapnet::net::fill_standard_streams();
    return hapnet::emulator::main_program({argv, static_cast<std::size_t>(argc)});
}
