// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "web/core/run_verdict.hpp"
#include "web/core/stage_plan.hpp"
#include "web/spawner.hpp"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::web {

/// Starts and stops an emulator and simulated peers at a page's request. The emulator keeps running
/// between the sessions of a loop, so that its settings remain. The peers are new in each session.
class Stage {
public:
    struct Handlers {
        std::function<void()> on_change; // the result of json() has changed
        std::function<void(const std::string&)> on_event;
        /// Reports the sockets of the started programs.
        std::function<void(const std::string& emulator, const std::vector<std::string>& peers)>
            on_daemons;
        std::function<void(int run)> on_run_end; // the files of the run are written
    };
    struct Setup {
        std::string programs; // folder of the programs
        std::string out;      // results: run-1, run-2, ... are made in it
        Choices choices;
    };

    /// Throws std::system_error when the folder of the sockets cannot be made.
    Stage(boost::asio::io_context& io, Setup setup, Handlers handlers);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Starts a session. The error says why it cannot. A stage that plays is refused; restart()
    /// stops it first.
    [[nodiscard]] base::Result<void> start(const Choice& choice);
    void restart(const Choice& choice);
    void stop();
    /// Sets whether the stage loops. Nothing else changes.
    void set_loop(bool loops);

    /// Call it regularly.
    void tick(base::TimePoint now);

    [[nodiscard]] bool is_idle() const { return children_.empty(); }
    [[nodiscard]] const Choice& choice() const { return choice_; }
    [[nodiscard]] const Choices& choices() const { return setup_.choices; }
    /// The folder, below `out`, for the last seconds that daemons save.
    static constexpr const char* kept_folder = "kept";
    [[nodiscard]] std::string kept() const { return setup_.out + "/" + kept_folder; }
    [[nodiscard]] int run() const { return run_; }
    [[nodiscard]] nlohmann::ordered_json json() const;

private:
    enum class State : std::uint8_t { stopped, starting, running, stopping, failed };
    struct Running {
        std::string name;
        std::string log;
        Child child;
        bool is_emulator = false;
        boost::asio::posix::stream_descriptor ended;
        std::optional<boost::asio::posix::stream_descriptor> output;
        std::string said;
        std::array<char, 4096> buffer{};
    };

    void begin();
    void begin_peers();
    void begin_watching_lab();
    [[nodiscard]] bool is_virtual() const { return choice_.mode == "virtual"; }
    void add(const Start& start, const std::string& name, bool is_emulator);
    void await_end(const std::shared_ptr<Running>& running);
    void await_output(const std::shared_ptr<Running>& running);
    void on_output(Running& running);
    void on_end(const std::shared_ptr<Running>& running);
    void on_all_peers_ended();
    void judge();
    void on_empty();
    void end_children(bool with_emulator);
    void fail(const std::string& why);
    void change(State state, std::string says);
    [[nodiscard]] bool is_child(const std::shared_ptr<Running>& running) const;
    [[nodiscard]] bool has_peers() const;
    [[nodiscard]] StageFolders folders() const;

    boost::asio::io_context& io_;
    Setup setup_;
    Handlers handlers_;
    Spawner spawner_;
    std::string sockets_; // the stage's own folder for sockets
    Choice choice_;
    std::optional<Choice> next_; // the choice to start when all children have ended
    State state_ = State::stopped;
    std::string says_ = "press start";
    int run_ = 0;
    std::optional<RunVerdict> last_; // verdict on the newest ended run; real time only
    Places places_;
    std::vector<std::shared_ptr<Running>> children_;
    std::vector<std::string> peer_sockets_;
    std::optional<base::TimePoint> kill_at_;
    std::optional<base::TimePoint> begin_at_; // time when the next session of the loop begins
};

} // namespace hapnet::web
