// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/commands/draft.h"

#include <QCoreApplication>
#include <QSettings>
#include <cctype>
#include <utility>

#include "widgets/commands/campaign_undo.h"
#include "widgets/commands/commands.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {
namespace {

/// The one place where two states differ, as a JSON pointer; empty: there are several, or rows came or went.
std::string placeOfChange(const nlohmann::json& before, const nlohmann::json& after) {
  const nlohmann::json patch = nlohmann::json::diff(before, after);
  if (patch.size() != 1) return {};
  const std::string path = patch[0].at("path");
  const char last = path.empty() ? '-' : path[path.rfind('/') + 1];
  const bool row = last == '-' || std::isdigit(static_cast<unsigned char>(last)) != 0;
  return row && patch[0].at("op") != "replace" ? std::string() : path;
}

QString keyWithoutCampaign(const std::string& name) {
  return QStringLiteral("draft/") + QString::fromStdString(name);
}

}  // namespace

Draft::Draft(SessionModel& session, CampaignUndo& undo, std::string name, std::function<void()> show)
    : session_(session), undo_(undo), name_(std::move(name)), show_(std::move(show)) {}

nlohmann::json Draft::typed(const nlohmann::json& base) const {
  const nlohmann::json kept = session_.draft(name_);
  return kept.is_object() && kept.at("base") == base ? kept.at("typed") : nlohmann::json();
}

bool Draft::ofAnother(const nlohmann::json& base) const {
  const nlohmann::json kept = session_.draft(name_);
  return kept.is_object() && kept.at("base") != base;
}

void Draft::push(const QString& what, nlohmann::json after, std::string place) {
  undo_.push(new DraftCommand(session_, what, name_, std::move(after), std::move(place), show_));
}

void Draft::keep(const QString& what, const nlohmann::json& base, const nlohmann::json& typed) {
  if (typed == shown_) return;
  push(what, {{"base", base}, {"typed", typed}}, placeOfChange(shown_, typed));
  shown_ = typed;
}

void Draft::discard() {
  if (session_.draft(name_).is_object())
    push(QCoreApplication::translate("Commands", "discard what was typed"), nullptr, {});
}

void Draft::takeOver(const nlohmann::json& base) {
  nlohmann::json kept = session_.draft(name_);
  if (!kept.is_object()) return;
  kept["base"] = base;
  push(QCoreApplication::translate("Commands", "show what was typed"), std::move(kept), {});
}

WindowDraft::WindowDraft(SessionModel& session, const std::string& name)
    : session_(&session),
      name_(name),
      session_number_(session.sessionNumber()),
      key_(session.draftKey(name)),
      of_campaign_(session.campaign() != nullptr) {}

nlohmann::json WindowDraft::typed() const {
  if (!atHand()) return {};
  if (of_campaign_) {
    const nlohmann::json kept = session_->draft(name_);
    return kept.is_object() ? kept.at("typed") : nlohmann::json();
  }
  const nlohmann::json kept =
      nlohmann::json::parse(QSettings().value(keyWithoutCampaign(name_)).toString().toStdString(), nullptr, false);
  return kept.is_discarded() ? nlohmann::json() : kept;
}

void WindowDraft::keep(const nlohmann::json& typed) {
  if (session_ == nullptr) return;
  if (!of_campaign_) {
    QSettings().setValue(keyWithoutCampaign(name_), QString::fromStdString(typed.dump()));
  } else if (session_->sessionNumber() == session_number_) {
    session_->setSetting(key_, typed.is_null() ? typed : nlohmann::json{{"base", nullptr}, {"typed", typed}});
  }
}

bool WindowDraft::atHand() const {
  if (session_ == nullptr) return false;
  if (!of_campaign_) return session_->campaign() == nullptr;
  return session_->sessionNumber() == session_number_ && session_->draftKey(name_) == key_;
}

}  // namespace spindrift::gui
