// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "web/daemon.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::web {

/// Makes several daemons save their last seconds under one name, and waits until the files exist.
class Saving {
public:
    /// Receives the paths as the daemons name them. An error: no daemon has saved anything.
    using OnSaved = std::function<void(const base::Result<std::vector<std::string>>& files)>;

    /// The longest wait for the files. The files of a daemon on another machine never appear here.
    static constexpr base::Duration patience{std::chrono::seconds{2}};

    /// Begins to save. A second request meanwhile is refused through `on_saved`.
    void begin(const std::vector<Daemon*>& daemons, const std::string& name, base::Duration last,
               OnSaved on_saved);

    /// Call it regularly.
    void tick(base::TimePoint now);

private:
    struct Pending {
        std::size_t awaited = 0; // replies that have not arrived yet
        std::vector<std::string> files;
        std::string refused; // the reason why a daemon saves nothing
        OnSaved on_saved;
        std::optional<base::TimePoint> until; // end of the wait for the files
    };
    std::shared_ptr<Pending> pending_;
};

} // namespace hapnet::web
