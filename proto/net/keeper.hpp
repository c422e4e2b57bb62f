// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::net {

/// Passes orders to save the last seconds to the thread that writes files, so that a client never
/// waits for a disk. Clients choose only names within the folder; existing files are never
/// overwritten, and the number of files is limited.
class Keeper {
public:
    static constexpr int files_max = 100;

    explicit Keeper(std::string folder) : folder_{std::move(folder)} {}

    struct Order {
        std::string path;
        base::TimePoint from;
    };
    /// Orders a file with what was held since `from`; gives its path. The file appears, whole, soon
    /// after. The error says why there will be none. `file` has no slash.
    [[nodiscard]] base::Result<std::string> order(const std::string& file, base::TimePoint from);

    /// Returns the waiting order, for the thread that writes.
    [[nodiscard]] std::optional<Order> take();
    /// Writes the file, of mode 0600. Where it refuses, trouble() tells why.
    void save(const std::string& path, std::string_view bytes);

    /// Returns the reason why a file could not be saved, once.
    [[nodiscard]] std::optional<std::string> trouble();

private:
    std::string folder_;
    int files_ = 0;
    std::mutex lock_; // guards the members below
    std::optional<Order> waiting_;
    std::optional<std::string> trouble_;
};

} // namespace hapnet::net
