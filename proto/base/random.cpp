// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"

#include <Random123/philox.h>

namespace hapnet::base {

namespace {

using Philox = r123::Philox4x32;

Philox::ctr_type philox(std::uint64_t key, const Philox::ctr_type& counter)
{
    const Philox::key_type words{
        {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
    return Philox{}(counter, words);
}

std::uint64_t low_words(const Philox::ctr_type& block)
{
    return static_cast<std::uint64_t>(block[1]) << 32 | block[0];
}

// Computes FNV-1a with 64 bits (Fowler, Noll, Vo). It is short, and sufficient to distinguish a few
// names.
std::uint64_t hash_of(std::string_view name)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : name) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3u;
    }
    return hash;
}

} // namespace

RandomStream Seed::stream(std::string_view name) const
{
    // The name is encrypted under the seed's key, so that neither similar seeds nor similar names
    // give related stream keys.
    const std::uint64_t hash = hash_of(name);
    const auto block = philox(
        value_, {{static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32), 0, 1}});
    return RandomStream{low_words(block), block[2]};
}

std::uint64_t RandomStream::bits(std::uint64_t index, std::uint32_t draw) const
{
    return low_words(philox(key_, {{static_cast<std::uint32_t>(index),
                                    static_cast<std::uint32_t>(index >> 32), draw, domain_}}));
}

double RandomStream::uniform(std::uint64_t index, std::uint32_t draw) const
{
    return static_cast<double>(bits(index, draw) >> 11) * 0x1p-53;
}

std::uint64_t RandomStream::below(std::uint32_t below, std::uint64_t index,
                                  std::uint32_t draw) const
{
    return ((bits(index, draw) >> 32) * below) >> 32;
}

} // namespace hapnet::base
