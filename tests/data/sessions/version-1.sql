-- The database of a session as version 1 of the schema wrote it.
pragma user_version = 1;
create table campaign (id integer primary key, name text not null, folder text not null unique, fingerprint text not null, imported_utc text not null);
create table result (id integer primary key, campaign integer not null references campaign(id) on delete cascade, kind text not null, program_version text not null, created_utc text not null, inputs_fingerprint text not null, options text not null, payload text not null);
create index result_by_kind on result (campaign, kind, id);
create table exclusion (campaign integer not null references campaign(id) on delete cascade, item text not null, reason text not null, created_utc text not null, primary key (campaign, item));
create table note (id integer primary key, campaign integer not null references campaign(id) on delete cascade, step text not null, text text not null, created_utc text not null);
create table setting (name text primary key, value text not null);
insert into campaign values (1, 'warm-up 1', 'campaigns/warm-up_1', '0123456789abcdef', '2026-01-31T08:00:00Z');
insert into result values (1, 1, 'fit', '0.1.0', '2026-01-31T09:00:00Z', 'fedcba9876543210', '{"points":["F1","F2"]}', '{"rms_um":1.25}');
insert into result values (2, 1, 'fit', '0.1.0', '2026-01-31T09:30:00Z', 'fedcba9876543211', '{}', '{"rms_um":1.5}');
insert into exclusion values (1, 'captures/images/a.jpg', 'blurred', '2026-01-31T09:10:00Z');
insert into note values (1, 1, 'Capture', 'door was open', '2026-01-31T09:20:00Z');
insert into setting values ('theme', '"dark"');
