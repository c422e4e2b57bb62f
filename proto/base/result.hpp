// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace hapnet::base {

/// The reason why input was refused, in words that say what to do.
struct Error {
    std::string message;
};

/// A value, or the reason why there is none. Has the names of std::expected.
template <typename T>
using Result = tl::expected<T, Error>;

/// The failing side of a Result: `return fail("wrong length");`
[[nodiscard]] inline tl::unexpected<Error> fail(std::string message)
{
    return tl::unexpected<Error>{Error{std::move(message)}};
}

} // namespace hapnet::base
