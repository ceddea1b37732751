// SPDX-License-Identifier: GPL-3.0-or-later
// Capturing while the user looks at something else: watches the folder, has every file checked on a thread of its own,
// and takes the answers into the session. Belongs to the session, not to a page: leaving the page changes nothing.
#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QObject>
#include <QTimer>
#include <deque>
#include <functional>
#include <map>
#include <memory>

#include "core/imaging/image.h"
#include "core/workflows/capture_intake.h"
#include "core/workflows/incoming.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

class IncomingService : public QObject {
  Q_OBJECT
 public:
  /// The one that belongs to the session.
  [[nodiscard]] static IncomingService& of(SessionModel& session);

  /// Begins to watch; `template_file` (may be empty) reads what a control prints. Returns one sentence if it cannot.
  QString start(const QString& folder, const QString& template_file = {});
  /// Stops watching; touches that are plausible are taken over.
  void stop();
  [[nodiscard]] bool running() const { return folder_ != nullptr; }
  /// Watched now, or the last time.
  [[nodiscard]] QString folder() const;
  [[nodiscard]] QString templateFile() const;
  /// What is wrong with the folder or with taking over, one sentence; empty: nothing.
  [[nodiscard]] QString problem() const;
  [[nodiscard]] const std::vector<IncomingItem>& items() const { return intake_.items(); }
  [[nodiscard]] QImage thumbnail(const std::string& name) const;
  /// Sentences of what is to be taken again now; what has been taken again since is not among them.
  [[nodiscard]] QStringList retakes();
  /// What is known of captures before they are checked together: how many of `listed` were checked and accepted as they
  /// arrived, and how many are to be taken again. Empty where nothing was accepted.
  [[nodiscard]] QString checkedOnArrival(int listed);
  /// Touches as they come in; null while none came.
  [[nodiscard]] const TouchFeed* touches() const { return intake_.touches(); }
  /// A picture of a camera, checked and taken over like a file.
  void take(const QString& name, std::shared_ptr<const GrayImage> image);
  /// Records what `take` was given and has not got to yet: before the campaign is left, or the program. What cannot be
  /// recorded stays in memory until its campaign is at hand again, and one sentence says so; empty: nothing is left.
  QString finishPictures();
  /// Files that were given by hand, one after the other: checked, copied and taken over as those that arrive in the
  /// watched folder. `done` gets what became of each, also when another campaign is chosen meanwhile: those that were
  /// not looked at say so.
  void takeFiles(const QStringList& files, std::function<void(const std::vector<IncomingItem>&)> done);
  /// True while nothing is waiting to be read or checked.
  [[nodiscard]] bool idle() const;

  [[nodiscard]] const MeasurementPlan& plan();
  /// Items of the plan that are captured.
  [[nodiscard]] const std::set<std::string>& done();
  [[nodiscard]] PlanProgress progress();
  /// The plan was changed (undo, redo, new).
  void planChanged();
  /// Seconds since the campaign start.
  [[nodiscard]] double campaignTime() const;
  /// How often the folder is looked at, and how long a file must stand still.
  void setPace(int look_ms, double settle_s, double patience_s);

 Q_SIGNALS:
  void changed();         ///< list, retakes, problem
  void touchesChanged();  ///< a touch came in
  void planProgressed();  ///< plan or what is done of it

 private:
  explicit IncomingService(SessionModel& session);
  void follow();
  void look();
  void examineNext();
  void finished(const IncomingFolder::Task& task, ExaminedFile examined, const QImage& picture);
  /// Files given by hand at one time.
  struct Handed {
    QStringList waiting;  ///< the first is being looked at
    std::vector<IncomingItem> answered;
    std::function<void(const std::vector<IncomingItem>&)> done;
  };
  void takeNext();
  void answerHanded(IncomingItem item);
  void giveUpHanded();
  /// False: it could not be stored; `failure_` says why.
  bool record(const ExaminedFile& found);
  void keepPicture(const std::string& name, const QImage& picture);
  void feed(const ExaminedFile& examined);
  /// What cannot be stored is kept for the next time.
  void flushTouches(bool all);
  /// Examines it again a moment later, as it could not be stored: `failure_` says why.
  void putOff(const IncomingFolder::Task& task);
  [[nodiscard]] std::shared_ptr<const IncomingContext> contextNow();
  [[nodiscard]] const PlanCaptures& captures();
  [[nodiscard]] std::string key(const char* what) const;
  [[nodiscard]] double now() const { return 1e-3 * static_cast<double>(clock_.elapsed()); }

  SessionModel& session_;
  JobRunner jobs_;
  QTimer timer_;
  QElapsedTimer clock_;
  FolderWatchOptions watch_;
  double patience_s_ = 5.0;
  std::int64_t campaign_ = 0;
  std::string campaign_folder_;
  int generation_ = -1;
  int pictures_ = 0;
  struct Taken {
    std::string id;
    std::shared_ptr<const GrayImage> image;
    std::int64_t written_ns = 0;
    std::shared_ptr<const IncomingContext> context;
    QString why_not = {};  ///< why it could not be recorded when its campaign was left
  };
  void examinePicture(const Taken& taken);
  void examineLater(const std::string& picture);
  [[nodiscard]] std::vector<Taken>::iterator pictureOfCampaign(const std::string& id);

  std::vector<Taken> taken_;             ///< pictures that are in memory alone, of other campaigns too
  std::vector<Touch> unstored_touches_;  ///< ready for touches.csv, which could not be written
  bool examining_ = false;
  std::deque<Handed> handed_;
  bool looking_ = false;  ///< at one of them
  std::unique_ptr<IncomingFolder> folder_;
  CaptureIntake intake_;
  std::map<std::string, QImage> thumbnails_;
  std::deque<std::string> pictured_;  ///< names of thumbnails_, oldest first
  QString failure_;
  std::optional<MeasurementPlan> plan_;
};

}  // namespace spindrift::gui
