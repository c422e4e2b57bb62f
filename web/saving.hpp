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
    /// The paths as the daemons name them; an error: none of them has saved anything.
    using OnSaved = std::function<void(const base::Result<std::vector<std::string>>& files)>;

    /// A daemon on another machine has its files there: they are not waited for longer.
    static constexpr base::Duration patience{std::chrono::seconds{2}};

    /// Begins to save. A second order meanwhile is refused through `on_saved`.
    void begin(const std::vector<Daemon*>& daemons, const std::string& name, base::Duration last,
               OnSaved on_saved);

    /// Call it now and then.
    void tick(base::TimePoint now);

private:
    struct Pending {
        std::size_t awaited = 0; // replies that have not come yet
        std::vector<std::string> files;
        std::string refused; // why a daemon saves nothing
        OnSaved on_saved;
        std::optional<base::TimePoint> until; // end of the wait for the files
    };
    std::shared_ptr<Pending> pending_;
};

} // namespace hapnet::web
