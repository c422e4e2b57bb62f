// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::peer {

/// Takes parsed texts of a command line; the first error stays and names its option.
class Taker {
public:
    template <typename Target, typename T>
    void take(Target& target, const char* option, base::Result<T> value)
    {
        if (value) {
            target = Target(*std::move(value));
        } else if (!error_) {
            error_ = fmt::format("{}: {}", option, value.error().message);
        }
    }
    void require(bool condition, std::string message)
    {
        if (!condition && !error_) error_ = std::move(message);
    }
    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

private:
    std::optional<std::string> error_;
};

} // namespace hapnet::peer
