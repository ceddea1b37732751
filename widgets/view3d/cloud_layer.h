// SPDX-License-Identifier: GPL-3.0-or-later
// A cloud in the scene: while the camera moves as many of its points as there is time for, at rest all that are in the
// picture, a part at a time (private to view3d).
#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "widgets/view3d/cloud_octree.h"
#include "widgets/view3d/scene_pieces.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

class CloudLayer {
 public:
  explicit CloudLayer(vtkRenderer* renderer) : renderer_(renderer) {}
  ~CloudLayer();
  CloudLayer(const CloudLayer&) = delete;
  CloudLayer& operator=(const CloudLayer&) = delete;

  /// A large cloud is sorted into its boxes in the background; until that is done a sample of it is drawn.
  void set(const ViewCloud& cloud, const std::optional<ColourScale>& scale);
  [[nodiscard]] bool empty() const { return cloud_.xyz_mm == nullptr || cloud_.xyz_mm->size() < 3; }
  [[nodiscard]] const ViewCloud& cloud() const { return cloud_; }
  [[nodiscard]] const std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& bounds() const { return bounds_; }

  /// Shows what a moving picture has time for.
  void showSome(const Camera& camera, const QSizeF& size, double ratio);
  /// How long that picture took: the next one shows more or less.
  void tookTime(double ms);
  /// True when all that the camera sees was shown since.
  [[nodiscard]] bool complete() const;
  /// What comes next at rest; everything shown before is hidden. `wait`: also for the sorting. False: not sorted yet.
  bool showNext(bool wait);
  void hide();

  /// Null while the cloud is being sorted.
  [[nodiscard]] const CloudOctree* tree();
  /// For each piece there is and each one to come.
  void onPieces(std::function<void(Piece&)> act);
  [[nodiscard]] std::size_t budget() const { return budget_; }

 private:
  struct Sorting;
  /// The points of a node, made when they are first wanted.
  Piece& piece(int node);
  void fill(Piece& piece, const std::uint32_t* indices, std::size_t count);
  void takeTree(bool wait);
  void listAll();
  void drop();

  vtkRenderer* renderer_;
  ViewCloud cloud_;
  std::optional<ColourScale> scale_;
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bounds_;
  std::shared_ptr<Sorting> sorting_;
  std::shared_ptr<const CloudOctree> tree_;
  std::unique_ptr<Piece> sample_;               ///< until there is a tree
  std::vector<std::unique_ptr<Piece>> pieces_;  ///< one a node
  std::vector<int> seen_;                       ///< nodes the camera sees, in their order
  std::size_t shown_ = 0;                       ///< of these
  bool all_seen_ = false;                       ///< seen_ is not only what a moving picture has time for
  Camera camera_;
  QSizeF size_;
  double ratio_ = 1.0;
  std::size_t budget_ = 0;
  std::function<void(Piece&)> act_;
};

}  // namespace spindrift::gui
