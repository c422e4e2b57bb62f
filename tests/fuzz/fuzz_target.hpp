// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

/// One fuzz target: called with arbitrary bytes, must neither crash nor break its property.
/// Linked either with libFuzzer or with replay.cpp, which calls it for the files of a corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hapnet::fuzz {

inline std::span<const std::byte> bytes_of(const std::uint8_t* data, std::size_t size)
{
    return std::as_bytes(std::span{data, size});
}

} // namespace hapnet::fuzz
