// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/key_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"

/// A key file that is read prints as a text that reads as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const auto bytes = fuzz::bytes_of(data, size);
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(bytes[i]);
    const auto file = secure::parse_key_file(text, "fuzz");
    if (!file) return 0;
    const std::string printed = secure::print_key_file(*file);
    const auto again = secure::parse_key_file(printed, "again");
    base::ensure(again && secure::print_key_file(*again) == printed);
    return 0;
}
