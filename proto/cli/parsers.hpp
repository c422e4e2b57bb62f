// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <functional>
#include <string>
#include <vector>

namespace hapnet::cli {

// Parsers for options, in addition to the formats of proto/base/formats.hpp and the parsers of
// proto/base/text.hpp. Errors quote the text and say what is possible.

template <typename T>
using Parser = std::function<base::Result<T>(const std::string& text)>;

/// Parses any whole number of 64 bits.
[[nodiscard]] base::Result<base::Seed> seed(const std::string& text);

/// Returns a parser that accepts one of some words, in small or capital letters.
[[nodiscard]] Parser<std::string> one_of(std::vector<std::string> words);

/// Parses the name of a value of an enum, in small or capital letters.
template <base::Named Enum>
[[nodiscard]] base::Result<Enum> named(const std::string& text)
{
    constexpr auto& all = base::names_of_enum<Enum>;
    return one_of({all.begin(), all.end()})(text).map(
        [](const std::string& name) { return *base::named<Enum>(name); });
}

} // namespace hapnet::cli
