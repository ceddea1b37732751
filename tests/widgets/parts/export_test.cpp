// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/export/exportable.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTimer>
#include <chrono>
#include <thread>

#include "tests/support/temp_folder.h"
#include "widgets/models/rows_model.h"

namespace spindrift::gui {
namespace {

TEST(Export, TableAsCsvAndDialogWritesEveryCheckedItem) {
  const testing::TempFolder folder;
  RowsModel model({QStringLiteral("Point"), QStringLiteral("EX, um")});
  Row row;
  row.id = QStringLiteral("F1");
  row.cells = {{QStringLiteral("F1")}, {QStringLiteral("12.4")}};
  model.setRows({row});
  EXPECT_EQ(tableCsv(model), QStringLiteral("Point,\"EX, um\"\nF1,12.4\n"));

  ExportDialog dialog({exportableOf(QStringLiteral("Heat map EX values"), &model)},
                      QString::fromStdString((folder / "out").string()));
  EXPECT_TRUE(dialog.exportNow());
  QFile file(QString::fromStdString((folder / "out" / "heat-map-ex-values.csv").string()));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_EQ(file.readAll(), "Point,\"EX, um\"\nF1,12.4\n");
}

TEST(Export, WhatTakesLongIsWrittenInTheBackgroundAndClosingCancelsIt) {
  const testing::TempFolder folder;
  Exportable slow{QStringLiteral("slow"), {QStringLiteral("pdf")}, {}};
  std::thread::id wrote_on;
  slow.write_in_background = [&](const QString&, JobContext&) { wrote_on = std::this_thread::get_id(); };
  ExportDialog dialog({slow}, QString::fromStdString(folder.path().string()));
  EXPECT_TRUE(dialog.exportNow());
  EXPECT_NE(wrote_on, std::thread::id());
  EXPECT_NE(wrote_on, std::this_thread::get_id());

  bool cancelled = false;
  slow.write_in_background = [&](const QString&, JobContext& job) {
    while (!job.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    cancelled = true;
    job.throwIfCancelled();
  };
  ExportDialog stopped({slow}, QString::fromStdString(folder.path().string()));
  stopped.show();
  QTimer::singleShot(20, &stopped, &QDialog::reject);
  EXPECT_FALSE(stopped.exportNow());
  EXPECT_TRUE(cancelled);
  EXPECT_FALSE(stopped.isVisible());
}

TEST(Export, AFolderThatCannotBeWrittenIsSaid) {
  RowsModel model({QStringLiteral("a")});
  ExportDialog dialog({exportableOf(QStringLiteral("x"), &model)}, QStringLiteral("/proc/nowhere"));
  EXPECT_FALSE(dialog.exportNow());
}

TEST(RowsModel, CheckingTellsTheOwner) {
  RowsModel model({QStringLiteral("Point")});
  Row row;
  row.id = QStringLiteral("F1");
  Cell cell{QStringLiteral("F1")};
  cell.checked = true;
  row.cells = {cell};
  model.setRows({row});
  QString id;
  bool now = true;
  QObject::connect(&model, &RowsModel::checkedChanged, [&](const QString& i, int, bool checked) {
    id = i;
    now = checked;
  });
  EXPECT_TRUE(model.setData(model.index(0, 0), Qt::Unchecked, Qt::CheckStateRole));
  EXPECT_EQ(id, QStringLiteral("F1"));
  EXPECT_FALSE(now);
}

}  // namespace
}  // namespace spindrift::gui
