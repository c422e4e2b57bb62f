// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/emulate.hpp"

#include <cstddef>

int main(int argc, char** argv)
{
    return hapnet::emulator::emulate({argv, static_cast<std::size_t>(argc)});
}
