// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/control/server.hpp"
#include "proto/control/turns.hpp"
#include "proto/net/text_file.hpp"
#include "proto/net/wake_event.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace hapnet::emulator {

/// Does the work of a run that takes time and is not urgent, on a thread of its own beside the
/// relaying one. It answers the clients of the control socket, reads the profile again, and shows
/// the progress of the run on a terminal. It submits work on the paths to the relaying thread, in
/// Turns.
class ControlDesk {
public:
    struct Setup {
        std::optional<std::string> socket{}; // path of the Unix socket
        std::optional<std::string> files{};  // the folder whose files clients may name
        /// The emulation without `work` and `folder`, which the desk adds.
        Emulation emulation;
        /// Reads the profile again. null: the run has no profile file.
        std::function<void(Emulation&)> reload{};
        /// Does periodic work. Returns the time at which it is to be called again.
        std::function<std::optional<base::TimePoint>(base::TimePoint now,
                                                     const control::DoWork& work)>
            look{};
    };

    /// Makes the socket and the thread, which waits for begin(). Everything that `setup` refers to
    /// must outlive the desk. Block the signals that only the calling thread may receive before
    /// this call. If there is nothing to do, no thread is made. Throws std::system_error when the
    /// socket cannot be made or the folder cannot be opened.
    explicit ControlDesk(Setup setup);
    /// Ends the thread. Open requests of clients are abandoned.
    ~ControlDesk();
    ControlDesk(const ControlDesk&) = delete;
    ControlDesk& operator=(const ControlDesk&) = delete;

    // Call these on the relaying thread.

    /// Lets the desk begin. From this call on, the calling thread does the work of turns(), and
    /// does not touch the parts that the desk uses. It may be called more than once.
    void begin();
    /// Returns the queue of work for the relaying thread.
    [[nodiscard]] control::Turns& turns() { return turns_; }
    [[nodiscard]] const control::Turns& turns() const { return turns_; }
    /// Orders the desk to read the profile again.
    void reload();
    /// Stops answering. Returns once the thread has ended.
    void close();

private:
    void run();

    Setup setup_;
    control::Turns turns_;
    std::unique_ptr<net::Folder> folder_;
    control::Subject subject_;
    std::unique_ptr<control::Server> server_;
    net::WakeEvent wake_;
    std::atomic<bool> wants_reload_{false};
    std::atomic<bool> has_begun_{false};
    std::atomic<bool> is_closing_{false};
    std::thread thread_; // last member: the thread uses the others
};

} // namespace hapnet::emulator
