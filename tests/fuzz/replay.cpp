// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

/// Feeds every file of the corpus folder named on the command line to the target.
int main(int argc, char** argv)
{
    if (argc != 2) return 2;
    int fed = 0;
    for (const auto& entry : std::filesystem::directory_iterator{argv[1]}) {
        std::ifstream file{entry.path(), std::ios::binary};
        const std::vector<char> text{std::istreambuf_iterator<char>{file}, {}};
        std::vector<std::uint8_t> bytes;
        for (const char c : text) bytes.push_back(static_cast<std::uint8_t>(c));
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
        ++fed;
    }
    std::printf("%d inputs replayed\n", fed);
    return fed > 0 ? 0 : 1;
}
