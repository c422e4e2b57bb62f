// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/checksums.hpp"
#include "lab/runner/session_store.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/memory_file.hpp"

#include <array>
#include <sstream>
#include <string>

/// Any lines of a shard, also with correct checksums, are sessions or damaged.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::istringstream input{std::string(data, data + size)};
    std::string text;
    std::size_t lines = 0;
    for (std::string line; std::getline(input, line); ++lines) {
        const bool is_object = line.size() > 2 && line.starts_with('{') && line.ends_with('}');
        text += (lines > 0 && is_object ? lab::runner::with_sum(line) : line) + '\n';
    }
    const fuzz::MemoryFile file{std::as_bytes(std::span{text})};
    const std::array paths{file.path()};
    const auto store = lab::runner::SessionStore::open_all(paths, {"limits", "fuzz"}, "fuzz");
    if (store) base::ensure((*store)->damaged_lines() <= lines);
    return 0;
}
