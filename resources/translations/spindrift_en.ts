<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en_GB" sourcelanguage="en">
<context>
    <name>ExcludeItems</name>
    <message numerus="yes">
        <source>Bring back %n captures</source>
        <translation>
            <numerusform>Bring back %n capture</numerusform>
            <numerusform>Bring back %n captures</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Exclude %n captures …</source>
        <translation>
            <numerusform>Exclude %n capture …</numerusform>
            <numerusform>Exclude %n captures …</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ArrivingPanel</name>
    <message numerus="yes">
        <source>Watching the folder %1: %n files, %2 accepted. Capturing goes on when this page is left.</source>
        <translation>
            <numerusform>Watching the folder %1: %n file, %2 accepted. Capturing goes on when this page is left.</numerusform>
            <numerusform>Watching the folder %1: %n files, %2 accepted. Capturing goes on when this page is left.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::AxisErrorsPage</name>
    <message numerus="yes">
        <source>%n scans, six errors each, relative to the first scan of their artefact.</source>
        <translation>
            <numerusform>%n scan, six errors, relative to the first scan of its artefact.</numerusform>
            <numerusform>%n scans, six errors each, relative to the first scan of their artefact.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CameraPanel</name>
    <message numerus="yes">
        <source>The camera has sent no complete frame for %1 s and %n frames with missing packets.</source>
        <translation>
            <numerusform>The camera has sent no complete frame for %1 s and %n frame with missing packets.</numerusform>
            <numerusform>The camera has sent no complete frame for %1 s and %n frames with missing packets.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ClosedLoopPage</name>
    <message numerus="yes">
        <source>%n cycles</source>
        <translation>
            <numerusform>%n cycle</numerusform>
            <numerusform>%n cycles</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ConnectionsPanel</name>
    <message numerus="yes">
        <source>Recording into log.csv of this campaign: %n rows, %1 of %2 columns have values. You may leave this page; recording continues.%3</source>
        <translation>
            <numerusform>Recording into log.csv of this campaign: %n row, %1 of %2 columns have values. You may leave this page; recording continues.%3</numerusform>
            <numerusform>Recording into log.csv of this campaign: %n rows, %1 of %2 columns have values. You may leave this page; recording continues.%3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n columns are mapped. Look at them live, or record them into the log of this campaign.</source>
        <translation>
            <numerusform>%n column is mapped. Look at it live, or record it into the log of this campaign.</numerusform>
            <numerusform>%n columns are mapped. Look at them live, or record them into the log of this campaign.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CycleModelPage</name>
    <message numerus="yes">
        <source>%1 parameters are determined in each of %n cycles.</source>
        <translation>
            <numerusform>%1 parameters are determined in the only cycle.</numerusform>
            <numerusform>%1 parameters are determined in each of %n cycles.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::EffectsPanel</name>
    <message numerus="yes">
        <source>%n effects</source>
        <translation>
            <numerusform>%n effect</numerusform>
            <numerusform>%n effects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>It can be read, and has a value at all %n points observed.</source>
        <translation>
            <numerusform>It can be read, and has a value at the only point observed.</numerusform>
            <numerusform>It can be read, and has a value at all %n points observed.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 of %n effects</source>
        <translation>
            <numerusform>%1 of %n effect</numerusform>
            <numerusform>%1 of %n effects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>leave out %n effects</source>
        <translation>
            <numerusform>leave out %n effect</numerusform>
            <numerusform>leave out %n effects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>consider %n effects again</source>
        <translation>
            <numerusform>consider %n effect again</numerusform>
            <numerusform>consider %n effects again</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::FiducialCapturePage</name>
    <message numerus="yes">
        <source>%n captures are there and none is checked yet. Checking decodes every image and says which to take again.</source>
        <translation>
            <numerusform>%n capture is there and not checked yet. Checking decodes every image and says which to take again.</numerusform>
            <numerusform>%n captures are there and none is checked yet. Checking decodes every image and says which to take again.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n captures are checked and can be used.</source>
        <translation>
            <numerusform>The only capture is checked and can be used.</numerusform>
            <numerusform>All %n captures are checked and can be used.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n are</source>
        <translation>
            <numerusform>one is</numerusform>
            <numerusform>%n are</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Of %n captures %1 can be used, %2 excluded.</source>
        <translation>
            <numerusform>Of %n capture %1 can be used, %2 excluded.</numerusform>
            <numerusform>Of %n captures %1 can be used, %2 excluded.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n of %1 captures failed the check (%2). Take them again, or exclude them: what decodes of them is evaluated as it is.</source>
        <translation>
            <numerusform>%n of %1 captures failed the check (%2). Take it again, or exclude it: what decodes of it is evaluated as it is.</numerusform>
            <numerusform>%n of %1 captures failed the check (%2). Take them again, or exclude them: what decodes of them is evaluated as it is.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::IncomingService</name>
    <message numerus="yes">
        <source>%n of %1 captures were checked as they arrived and accepted.</source>
        <translation>
            <numerusform>%n of %1 captures was checked as it arrived and accepted.</numerusform>
            <numerusform>%n of %1 captures were checked as they arrived and accepted.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n are to be taken again.</source>
        <translation>
            <numerusform>%n is to be taken again.</numerusform>
            <numerusform>%n are to be taken again.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::JobBar</name>
    <message numerus="yes">
        <source>%n waiting</source>
        <translation>
            <numerusform>%n waiting</numerusform>
            <numerusform>%n waiting</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::LiveTouchPanel</name>
    <message numerus="yes">
        <source>, %n touches</source>
        <translation>
            <numerusform>, %n touch</numerusform>
            <numerusform>, %n touches</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::MachinePage</name>
    <message numerus="yes">
        <source>%n points added below. With them the heat map would be uncertain by %1 µm on average and %2 µm at worst (0.5 µm in X and Y, 1 µm in Z per fiducial). Apply the changes, or discard them.</source>
        <translation>
            <numerusform>%n point added below. With it the heat map would be uncertain by %1 µm on average and %2 µm at worst (0.5 µm in X and Y, 1 µm in Z per fiducial). Apply the changes, or discard them.</numerusform>
            <numerusform>%n points added below. With them the heat map would be uncertain by %1 µm on average and %2 µm at worst (0.5 µm in X and Y, 1 µm in Z per fiducial). Apply the changes, or discard them.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::MainWindow</name>
    <message numerus="yes">
        <source>%n rows of log.csv</source>
        <translation>
            <numerusform>%n row of log.csv</numerusform>
            <numerusform>%n rows of log.csv</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NoisePanel</name>
    <message numerus="yes">
        <source>%n readings lie far from all others; they have little weight.</source>
        <translation>
            <numerusform>One reading lies far from all others; it has little weight.</numerusform>
            <numerusform>%n readings lie far from all others; they have little weight.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ReportPage</name>
    <message numerus="yes">
        <source>%n pages</source>
        <translation>
            <numerusform>%n page</numerusform>
            <numerusform>%n pages</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n figures</source>
        <translation>
            <numerusform>%n figure</numerusform>
            <numerusform>%n figures</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n tables</source>
        <translation>
            <numerusform>%n table</numerusform>
            <numerusform>%n tables</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ScanCapturePage</name>
    <message numerus="yes">
        <source>%n scans are there and none is checked yet. Checking reads every cloud and says which to take again.</source>
        <translation>
            <numerusform>%n scan is there and not checked yet. Checking reads every cloud and says which to take again.</numerusform>
            <numerusform>%n scans are there and none is checked yet. Checking reads every cloud and says which to take again.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n scans are complete and can be used.</source>
        <translation>
            <numerusform>The only scan is complete and can be used.</numerusform>
            <numerusform>All %n scans are complete and can be used.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n of %1 scans are incomplete or cannot be used (%2). Scan again, or exclude them: the others are evaluated without them.</source>
        <translation>
            <numerusform>%n of %1 scans is incomplete or cannot be used (%2). Scan again, or exclude it: the others are evaluated without it.</numerusform>
            <numerusform>%n of %1 scans are incomplete or cannot be used (%2). Scan again, or exclude them: the others are evaluated without them.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n profiles</source>
        <translation>
            <numerusform>%n profile</numerusform>
            <numerusform>%n profiles</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n points near edges</source>
        <translation>
            <numerusform>%n point near edges</numerusform>
            <numerusform>%n points near edges</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n outliers</source>
        <translation>
            <numerusform>%n outlier</numerusform>
            <numerusform>%n outliers</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::TouchCapturePage</name>
    <message numerus="yes">
        <source>%n touches are there and none is checked yet. Checking compares every touch with all others and says which to take again.</source>
        <translation>
            <numerusform>%n touch is there and not checked yet. Checking compares every touch with all others and says which to take again.</numerusform>
            <numerusform>%n touches are there and none is checked yet. Checking compares every touch with all others and says which to take again.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n touches are plausible and none is missing.</source>
        <translation>
            <numerusform>The only touch is plausible and none is missing.</numerusform>
            <numerusform>All %n touches are plausible and none is missing.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n touches are plausible. Whether one is missing shows when a second cycle is there to compare with.</source>
        <translation>
            <numerusform>The only touch is plausible. Whether one is missing shows when a second cycle is there to compare with.</numerusform>
            <numerusform>All %n touches are plausible. Whether one is missing shows when a second cycle is there to compare with.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Program checked: %n touches in %1 moves inside the travel, none through the artefact, a retract after each, safe height %2 mm. Export (Ctrl+E) writes it.</source>
        <translation>
            <numerusform>Program checked: %n touch in %1 moves inside the travel, not through the artefact, a retract after it, safe height %2 mm. Export (Ctrl+E) writes it.</numerusform>
            <numerusform>Program checked: %n touches in %1 moves inside the travel, none through the artefact, a retract after each, safe height %2 mm. Export (Ctrl+E) writes it.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n touches from below are left out, where the stem of a ball may be.</source>
        <translation>
            <numerusform>%n touch from below is left out, where the stem of a ball may be.</numerusform>
            <numerusform>%n touches from below are left out, where the stem of a ball may be.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::VerifyPage</name>
    <message numerus="yes">
        <source>%n values compared</source>
        <translation>
            <numerusform>%n value compared</numerusform>
            <numerusform>%n values compared</numerusform>
        </translation>
    </message>
</context>
</TS>
