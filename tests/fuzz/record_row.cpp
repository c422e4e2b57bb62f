// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/codec.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>

/// Bytes that decode() accepts encode to themselves.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const auto bytes = fuzz::bytes_of(data, size);
    for (const auto layout :
         {record::Layout{}, record::Layout::of_version_4(), record::Layout{}.with_bodies()}) {
        const auto row = record::decode(bytes, layout);
        if (row) base::ensure(std::ranges::equal(record::encode(*row, layout), bytes));
    }
    return 0;
}
