// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/cloud_layer.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <QThreadPool>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>

namespace spindrift::gui {
namespace {

/// Of a picture of a moving view, ms: with the painting over it that makes more than 30 pictures a second.
constexpr double aimed_ms = 22.0;
constexpr std::size_t first_budget = 80'000;
constexpr std::size_t least_budget = CloudOctree::points_per_node;
constexpr std::size_t most_budget = 4'000'000;
/// Made for one moving picture; others are drawn as soon as there is time for them.
constexpr int most_new_pieces = 6;
/// Drawn at once at rest: well within the time the window may take to answer.
constexpr std::size_t points_at_rest = 80'000;
/// Sorted without a thread: a hundredth of a second.
constexpr std::size_t few_points = 100'000;

}  // namespace

struct CloudLayer::Sorting {
  std::atomic<bool> cancelled = false;
  std::promise<std::shared_ptr<const CloudOctree>> promise;
  std::future<std::shared_ptr<const CloudOctree>> tree = promise.get_future();
};

CloudLayer::~CloudLayer() {
  if (sorting_ != nullptr) sorting_->cancelled = true;
}

void CloudLayer::drop() {
  if (sorting_ != nullptr) sorting_->cancelled = true;
  sorting_.reset();
  if (sample_ != nullptr) renderer_->RemoveActor(sample_->actor);
  for (const auto& piece : pieces_)
    if (piece != nullptr) renderer_->RemoveActor(piece->actor);
  sample_.reset();
  pieces_.clear();
  seen_.clear();
  shown_ = 0;
  all_seen_ = false;
}

void CloudLayer::listAll() {
  if (all_seen_) return;
  seen_ = tree_->visible(camera_, size_, std::numeric_limits<std::size_t>::max());
  all_seen_ = true;
}

void CloudLayer::set(const ViewCloud& cloud, const std::optional<ColourScale>& scale) {
  const bool same_points = cloud.xyz_mm == cloud_.xyz_mm && cloud_.xyz_mm != nullptr;
  const auto tree = same_points ? tree_ : nullptr;
  drop();
  tree_ = tree;
  cloud_ = cloud;
  scale_ = scale;
  budget_ = first_budget;
  if (!same_points) bounds_.reset();
  if (empty()) return;
  const std::size_t count = cloud_.xyz_mm->size() / 3;
  if (!same_points) {
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
    Eigen::Vector3f high = -low;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Map<const Eigen::Vector3f> p(cloud_.xyz_mm->data() + 3 * i);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    bounds_ = {low.cast<double>(), high.cast<double>()};
  }
  if (tree_ != nullptr) {
    pieces_.resize(tree_->nodes().size());
    return;
  }
  sorting_ = std::make_shared<Sorting>();
  const auto sort = [sorting = sorting_, points = cloud_.xyz_mm] {
    try {
      sorting->promise.set_value(CloudOctree::build(points, sorting->cancelled));
    } catch (const std::bad_alloc&) {
      sorting->promise.set_value(nullptr);  // the sample has to do
    }
  };
  count <= few_points ? sort() : QThreadPool::globalInstance()->start(sort);
}

void CloudLayer::takeTree(bool wait) {
  if (sorting_ == nullptr) return;
  if (!wait && sorting_->tree.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  tree_ = sorting_->tree.get();
  sorting_.reset();
  if (tree_ == nullptr) return;
  pieces_.resize(tree_->nodes().size());
  if (sample_ != nullptr) renderer_->RemoveActor(sample_->actor);
  sample_.reset();
}

const CloudOctree* CloudLayer::tree() {
  takeTree(false);
  return tree_.get();
}

void CloudLayer::onPieces(std::function<void(Piece&)> act) {
  act_ = std::move(act);
  if (sample_ != nullptr) act_(*sample_);
  for (const auto& piece : pieces_)
    if (piece != nullptr) act_(*piece);
}

void CloudLayer::fill(Piece& piece, const std::uint32_t* indices, std::size_t count) {
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(count));
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(static_cast<vtkIdType>(count));
  float* xyz = coordinates->GetPointer(0);
  unsigned char* rgb = colours->GetPointer(0);
  const QRgb plain = theme().series[0].rgb();
  const bool coloured = cloud_.scalar != nullptr && scale_.has_value();
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t i = indices[j];
    std::memcpy(xyz + 3 * j, cloud_.xyz_mm->data() + 3 * i, 3 * sizeof(float));
    const QRgb c = coloured ? scale_->rgb(static_cast<double>((*cloud_.scalar)[i])) : plain;
    rgb[3 * j] = static_cast<unsigned char>(qRed(c));
    rgb[3 * j + 1] = static_cast<unsigned char>(qGreen(c));
    rgb[3 * j + 2] = static_cast<unsigned char>(qBlue(c));
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->InsertNextValue(0);
  offsets->InsertNextValue(static_cast<int>(count));
  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(count));
  std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + count, 0);
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(offsets, connectivity);
  piece.data->SetPoints(points);
  piece.data->SetVerts(vertices);
  piece.data->GetPointData()->SetScalars(colours);
  piece.mapper->SetColorModeToDirectScalars();
  piece.actor->GetProperty()->LightingOff();
  piece.actor->VisibilityOff();
  if (act_) act_(piece);
  renderer_->AddActor(piece.actor);
}

Piece& CloudLayer::piece(int node) {
  auto& kept = pieces_[static_cast<std::size_t>(node)];
  if (kept == nullptr) {
    kept = std::make_unique<Piece>();
    const CloudOctree::Node& n = tree_->nodes()[static_cast<std::size_t>(node)];
    fill(*kept, tree_->order().data() + n.first, n.count);
  }
  kept->actor->GetProperty()->SetPointSize(static_cast<float>(cloud_.point_size * ratio_));
  return *kept;
}

void CloudLayer::hide() {
  if (sample_ != nullptr) sample_->actor->VisibilityOff();
  for (const auto& piece : pieces_)
    if (piece != nullptr) piece->actor->VisibilityOff();
}

void CloudLayer::showSome(const Camera& camera, const QSizeF& size, double ratio) {
  if (empty()) return;
  camera_ = camera;
  size_ = size;
  ratio_ = ratio;
  takeTree(false);
  hide();
  seen_.clear();
  shown_ = 0;
  all_seen_ = false;
  if (tree_ == nullptr) {
    if (sample_ == nullptr) {
      const std::size_t count = cloud_.xyz_mm->size() / 3;
      const std::size_t step = std::max<std::size_t>(1, count / first_budget);
      std::vector<std::uint32_t> indices;
      for (std::size_t i = 0; i < count; i += step) indices.push_back(static_cast<std::uint32_t>(i));
      sample_ = std::make_unique<Piece>();
      fill(*sample_, indices.data(), indices.size());
    }
    sample_->actor->GetProperty()->SetPointSize(static_cast<float>(cloud_.point_size * ratio_));
    sample_->actor->VisibilityOn();
    return;
  }
  seen_ = tree_->visible(camera, size, budget_);
  all_seen_ = tree_->order().size() <= budget_;
  int made = 0;
  for (const int node : seen_) {
    if (pieces_[static_cast<std::size_t>(node)] == nullptr && ++made > most_new_pieces) break;
    piece(node).actor->VisibilityOn();
    ++shown_;
  }
}

void CloudLayer::tookTime(double ms) {
  if (tree_ == nullptr || empty()) return;
  // In small steps: what took long may have waited for something else.
  const double factor = std::clamp(aimed_ms / std::max(ms, 1.0), 0.7, all_seen_ ? 1.0 : 1.25);
  budget_ = std::clamp(static_cast<std::size_t>(static_cast<double>(budget_) * factor), least_budget, most_budget);
}

bool CloudLayer::complete() const {
  if (empty()) return true;
  return tree_ == nullptr ? sorting_ == nullptr : all_seen_ && shown_ >= seen_.size();
}

bool CloudLayer::showNext(bool wait) {
  if (tree_ == nullptr) {
    takeTree(wait);
    if (tree_ == nullptr) return false;
    shown_ = 0;
  }
  listAll();
  hide();
  std::size_t points = 0;
  while (shown_ < seen_.size() && points < points_at_rest) {
    const int node = seen_[shown_++];
    points += tree_->nodes()[static_cast<std::size_t>(node)].count;
    piece(node).actor->VisibilityOn();
  }
  return true;
}

}  // namespace spindrift::gui
