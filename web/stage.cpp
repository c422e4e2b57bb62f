// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/stage.hpp"

#include "proto/net/clock.hpp"
#include "web/core/state.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::web {

namespace {

using boost::system::error_code;

/// The time after which a child that does not end on request is killed.
constexpr base::Duration killed_after{std::chrono::seconds{5}};
constexpr base::Duration between_sessions{std::chrono::milliseconds{500}};
constexpr std::size_t said_bytes_max = 16384;

/// Makes a new folder for sockets: below $XDG_RUNTIME_DIR, or else below /tmp.
std::string socket_folder()
{
    const char* runtime = std::getenv("XDG_RUNTIME_DIR");
    std::string pattern = std::string{runtime != nullptr && *runtime == '/' ? runtime : "/tmp"} +
                          "/hapnet-web-XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) {
        throw std::system_error{errno, std::generic_category(), pattern};
    }
    return pattern;
}

/// Returns the last line of a file that is not empty.
std::string last_line(const std::string& file)
{
    std::ifstream in{file};
    std::string last;
    for (std::string line; std::getline(in, line);) {
        if (!line.empty()) last = line;
    }
    return last.substr(0, 300);
}

/// Returns the whole text of a file; empty where there is none.
std::string text_of(const std::string& file)
{
    std::ifstream in{file};
    return {std::istreambuf_iterator<char>{in}, {}};
}

/// Returns the exit code of a process, 128 + n after signal n; nullopt while it runs.
std::optional<int> exit_of(pid_t pid)
{
    int status = 0;
    const pid_t ended = waitpid(pid, &status, WNOHANG);
    if (ended == 0) return std::nullopt;
    if (ended < 0) return 1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

Stage::Stage(boost::asio::io_context& io, Setup setup, Handlers handlers)
    : io_{io}, setup_{std::move(setup)}, handlers_{std::move(handlers)}, sockets_{socket_folder()}
{}

Stage::~Stage()
{
    for (const auto& running : children_) kill(running->child.pid, SIGTERM);
    const auto deadline = net::monotonic_now() + killed_after;
    for (const auto& running : children_) {
        while (waitpid(running->child.pid, nullptr, WNOHANG) == 0) {
            if (net::monotonic_now() >= deadline) kill(running->child.pid, SIGKILL);
            net::sleep_until(net::monotonic_now() + std::chrono::milliseconds{5});
        }
    }
    std::error_code ignored;
    std::filesystem::remove_all(sockets_, ignored);
}

StageFolders Stage::folders() const
{
    return {.programs = setup_.programs,
            .sockets = sockets_,
            .results = fmt::format("{}/run-{}", setup_.out, run_),
            .kept = kept()};
}

base::Result<void> Stage::start(const Choice& choice)
{
    if (!children_.empty()) return base::fail("the stage plays already: stop it first, or restart");
    choice_ = choice;
    begin();
    return {};
}

void Stage::restart(const Choice& choice)
{
    if (children_.empty()) {
        choice_ = choice;
        return begin();
    }
    next_ = choice;
    begin_at_.reset();
    change(State::stopping, "stops, to begin anew");
    end_children(/*with_emulator*/ true);
}

void Stage::stop()
{
    next_.reset();
    begin_at_.reset();
    if (children_.empty()) return change(State::stopped, "press start");
    change(State::stopping, "stops");
    end_children(/*with_emulator*/ true);
}

void Stage::set_loop(bool loops)
{
    choice_.loop = loops;
    handlers_.on_change();
}

void Stage::begin()
{
    try {
        ++run_;
        std::filesystem::create_directories(folders().results);
        std::filesystem::create_directories(kept());
        if (is_virtual()) {
            change(State::starting, "hapnet-lab starts");
            return add(lab_start(choice_, folders(), setup_.choices), "hapnet-lab", true);
        }
        change(State::starting, "the emulator starts");
        add(emulator_start(choice_, folders()), "emulator", true);
    } catch (const std::system_error& error) {
        fail(error.what());
    }
}

void Stage::begin_peers()
{
    begin_at_.reset();
    try {
        std::filesystem::create_directories(folders().results);
        peer_sockets_.clear();
        for (int id = 1; id <= choice_.peers; ++id) {
            const Start start = peer_start(id, choice_, folders(), places_);
            add(start, fmt::format("peer {}", id), false);
            peer_sockets_.push_back(start.socket);
        }
    } catch (const std::system_error& error) {
        return fail(error.what());
    }
    change(State::running,
           fmt::format("session {} plays: task {}, {}", run_, choice_.task, choice_.algorithm));
    handlers_.on_event(fmt::format("session {} begins: task {}, algorithm {}", run_, choice_.task,
                                   choice_.algorithm));
    handlers_.on_daemons(sockets_ + "/emulator.sock", peer_sockets_);
}

void Stage::begin_watching_lab()
{
    const std::string socket = sockets_ + "/lab.sock";
    change(State::running,
           fmt::format("virtual time: task {}, {}", choice_.task, choice_.algorithm));
    handlers_.on_event(fmt::format("a session in virtual time begins: task {}, algorithm {}",
                                   choice_.task, choice_.algorithm));
    handlers_.on_daemons(socket, lab_peer_sockets(socket, choice_.peers));
}

void Stage::add(const Start& start, const std::string& name, bool is_emulator)
{
    const Child child = spawner_.start({start.words, start.log, is_emulator});
    auto running = std::make_shared<Running>(
        Running{.name = name,
                .log = start.log,
                .child = child,
                .is_emulator = is_emulator,
                .ended = boost::asio::posix::stream_descriptor{io_, child.ended},
                .output = std::nullopt,
                .said = {}});
    if (child.output >= 0) running->output.emplace(io_, child.output);
    children_.push_back(running);
    await_end(running);
    if (running->output) await_output(running);
}

void Stage::await_end(const std::shared_ptr<Running>& running)
{
    running->ended.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                              [this, running](const error_code& error) {
                                  if (!error) on_end(running);
                              });
}

void Stage::await_output(const std::shared_ptr<Running>& running)
{
    running->output->async_read_some(boost::asio::buffer(running->buffer),
                                     [this, running](const error_code& error, std::size_t bytes) {
                                         // Output of an earlier session arrives too late.
                                         if (error || !is_child(running)) return;
                                         if (running->said.size() < said_bytes_max) {
                                             running->said.append(running->buffer.data(), bytes);
                                             on_output(*running);
                                         }
                                         await_output(running);
                                     });
}

/// Reads where the emulator listens. Then the peers can be started.
void Stage::on_output(Running& running)
{
    if (state_ != State::starting) return;
    const auto end = running.said.find('\n');
    if (end == std::string::npos) return;
    if (is_virtual()) return begin_watching_lab();
    auto places = places_in(running.said.substr(0, end), choice_.peers);
    if (!places) return fail(places.error().message);
    places_ = *std::move(places);
    begin_peers();
}

void Stage::on_end(const std::shared_ptr<Running>& running)
{
    const auto code = exit_of(running->child.pid);
    // A child between fork() and exec() still holds descriptors that this process has closed. So an
    // event of a closed descriptor may arrive as that of a new one.
    if (!code) return await_end(running);
    std::erase(children_, running);
    const bool is_asked_for = state_ == State::stopping || state_ == State::failed;
    if (!is_asked_for && (*code != 0 || running->is_emulator)) {
        const std::string why = last_line(running->log);
        fail(fmt::format("{} ended with exit code {}{}{}", running->name, *code,
                         why.empty() ? "" : ": ", why));
    }
    if (children_.empty()) return on_empty();
    if (!has_peers() && state_ == State::running) on_all_peers_ended();
}

bool Stage::is_child(const std::shared_ptr<Running>& running) const
{
    return std::ranges::find(children_, running) != children_.end();
}

bool Stage::has_peers() const
{
    return std::ranges::any_of(children_, [](const auto& one) { return !one->is_emulator; });
}

/// Judges the run. In a loop the emulator keeps running and has no statistics yet.
void Stage::judge()
{
    last_.reset();
    if (is_virtual() || peer_sockets_.empty()) return;
    std::vector<ProgramStatistics> programs;
    for (int id = 1; id <= choice_.peers; ++id) {
        programs.push_back({capital_letter(static_cast<std::size_t>(id - 1)),
                            text_of(fmt::format("{}/peer-{}.json", folders().results, id))});
    }
    auto emulator = text_of(folders().results + "/emulator.json");
    if (!emulator.empty()) programs.push_back({"the emulator", std::move(emulator)});
    last_ = verdict_of(run_, programs);
}

void Stage::on_all_peers_ended()
{
    handlers_.on_run_end(run_);
    judge();
    if (last_) handlers_.on_event(last_->text());
    if (!choice_.loop) {
        change(State::stopping, "the session has ended");
        return end_children(/*with_emulator*/ true);
    }
    ++run_;
    begin_at_ = net::monotonic_now() + between_sessions;
}

void Stage::on_empty()
{
    kill_at_.reset();
    begin_at_.reset();
    handlers_.on_run_end(run_); // the daemons stay known: pages show their last state
    judge();
    if (next_) {
        choice_ = *std::exchange(next_, std::nullopt);
        return begin();
    }
    if (state_ == State::stopping) change(State::stopped, "press start");
}

void Stage::end_children(bool with_emulator)
{
    for (const auto& running : children_) {
        if (with_emulator || !running->is_emulator) kill(running->child.pid, SIGTERM);
    }
    kill_at_ = net::monotonic_now() + killed_after;
}

void Stage::fail(const std::string& why)
{
    next_.reset();
    begin_at_.reset();
    change(State::failed, why);
    handlers_.on_event("the stage has stopped: " + why);
    end_children(/*with_emulator*/ true);
}

void Stage::tick(base::TimePoint now)
{
    if (base::is_due(begin_at_, now)) begin_peers();
    if (!base::is_due(kill_at_, now)) return;
    for (const auto& running : children_) kill(running->child.pid, SIGKILL);
    kill_at_.reset();
}

void Stage::change(State state, std::string says)
{
    state_ = state;
    says_ = std::move(says);
    handlers_.on_change();
}

nlohmann::ordered_json Stage::json() const
{
    constexpr std::array names{"stopped", "starting", "running", "stopping", "failed"};
    return {{"available", true},
            {"state", names.at(static_cast<std::size_t>(state_))},
            {"says", says_},
            {"run", run_},
            {"last", last_ ? last_->json() : nlohmann::ordered_json(nullptr)},
            {"loop", choice_.loop},
            {"choice", choice_.json()},
            {"choices", setup_.choices.json()}};
}

} // namespace hapnet::web
