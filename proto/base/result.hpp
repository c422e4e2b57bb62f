// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace hapnet::base {

/// The reason why input was refused, with advice on what to do.
struct Error {
    std::string message;
};

/// A value, or the reason why there is none. The members are those of std::expected.
template <typename T>
using Result = tl::expected<T, Error>;

/// Makes a Result that failed: `return fail("wrong length");`
[[nodiscard]] inline tl::unexpected<Error> fail(std::string message)
{
    return tl::unexpected<Error>{Error{std::move(message)}};
}

} // namespace hapnet::base
