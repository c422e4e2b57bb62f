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

/// Passes orders to save recent events to the thread that writes files, so that a client never
/// waits for a disk. Clients choose only names within the folder. Existing files are never
/// overwritten, and the number of files is limited.
class Keeper {
public:
    static constexpr int files_max = 100;

    explicit Keeper(std::string folder) : folder_{std::move(folder)} {}

    struct Order {
        std::string path;
        base::TimePoint from;
    };
    /// Orders a file with the events since `from` and returns its path. The complete file appears
    /// soon after. The error says why there will be no file. `file` must not contain a slash.
    [[nodiscard]] base::Result<std::string> order(const std::string& file, base::TimePoint from);

    /// Returns the waiting order, for the thread that writes.
    [[nodiscard]] std::optional<Order> take();
    /// Writes the file with mode 0600. If this fails, trouble() returns the reason.
    void save(const std::string& path, std::string_view bytes);

    /// Returns the reason why a file could not be saved. Each reason is returned once.
    [[nodiscard]] std::optional<std::string> trouble();

private:
    std::string folder_;
    int files_ = 0;
    std::mutex lock_; // guards the members below
    std::optional<Order> waiting_;
    std::optional<std::string> trouble_;
};

} // namespace hapnet::net
