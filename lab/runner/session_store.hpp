// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/session_spec.hpp"
#include "proto/base/result.hpp"

#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace hapnet::lab::runner {

/// What an experiment's folder of results is about. Another experiment's sessions would mix.
struct FolderIdentity {
    std::string kind;
    std::string title;
};

/// The sessions that an experiment has played, in a file of JSON lines that each is appended to
/// as soon as it is over: what ends a run loses none of them. May be used by several threads; no
/// session is played twice.
class SessionStore {
public:
    /// Reads what is there, and keeps others from writing. The error: the file belongs to another
    /// experiment, or another run has it. Throws std::system_error when it cannot be written.
    /// `program` is who plays: sessions of another one are not known.
    [[nodiscard]] static base::Result<std::unique_ptr<SessionStore>>
    open(const std::string& path, const FolderIdentity& identity, std::string program);
    ~SessionStore();
    SessionStore(const SessionStore&) = delete;
    SessionStore& operator=(const SessionStore&) = delete;

    /// What is known of a session, or else what comes of `play`. Throws std::system_error when it
    /// cannot be kept.
    [[nodiscard]] base::Result<experiment::PlayedSession>
    played(const experiment::SessionSpec& spec, const experiment::PlaySession& play);

    struct Counts {
        std::size_t played = 0;
        std::size_t reused = 0; // of an earlier run
    };
    [[nodiscard]] Counts counts() const;

    /// Lines of the file that are no session: cut off when something ended its writer, say.
    [[nodiscard]] std::size_t damaged_lines() const { return damaged_; }

private:
    SessionStore(int descriptor, std::string path, std::string program);
    [[nodiscard]] base::Result<void> read(const FolderIdentity& identity);
    void take_line(const nlohmann::ordered_json& line);
    void append(const std::string& line) const;

    int descriptor_;
    std::string path_;
    std::string program_;
    std::size_t damaged_ = 0;

    mutable std::mutex mutex_; // over all below
    std::condition_variable changed_;
    std::map<std::string, experiment::PlayedSession> sessions_;
    std::set<std::string> from_before_; // those that this run has not asked for yet
    std::set<std::string> being_played_;
    Counts counts_;
};

} // namespace hapnet::lab::runner
