//! Files in the formats of the networks, made from a wave of known peak.

use std::fmt::Write;

/// 203 samples of a burst at 0.02 s, peak below 100.
pub const SAMPLES: usize = 203;
pub const DT: f64 = 0.02;
/// What a corrected GeoNet file has before its zero of time (s).
pub const PREPENDED: f64 = 1.0;

/// A burst; `scale` sets its size, `phase` tells components apart.
pub fn wave(scale: f64, phase: f64) -> Vec<f64> {
    (0..SAMPLES)
        .map(|i| {
            let t = i as f64 * DT;
            scale * (-(t - 2.0_f64).powi(2)).exp() * (9.0 * t + phase).sin()
        })
        .collect()
}

/// Rounded as a file of so many decimals has it.
pub fn rounded(values: &[f64], decimals: usize) -> Vec<f64> {
    values.iter().map(|x| format!("{x:.decimals$}").parse().unwrap()).collect()
}

/// The value of the largest size and its time.
pub fn peak(values: &[f64]) -> (f64, f64) {
    let at =
        (0..values.len()).max_by(|&i, &j| values[i].abs().total_cmp(&values[j].abs())).unwrap();
    (values[at], at as f64 * DT)
}

fn rows(out: &mut String, values: &[f64], per_line: usize, width: usize, decimals: usize) {
    for row in values.chunks(per_line) {
        for value in row {
            write!(out, "{value:width$.decimals$}").unwrap();
        }
        out.push('\n');
    }
}

/// GeoNet: each component a name and its acceleration, velocity, displacement in mm and s; V1A if
/// `raw`.
pub fn geonet(components: &[(&str, f64)], raw: bool) -> String {
    let mut out = String::new();
    for (name, scale) in components {
        let series = [wave(*scale, 0.3), wave(scale / 10.0, 0.9), wave(scale / 100.0, 1.4)];
        let series = [rounded(&series[0], 1), rounded(&series[1], 1), rounded(&series[2], 1)];
        let (kind, n) = (if raw { "Uncorrected" } else { "Corrected" }, SAMPLES);
        let counts = if raw { [n, 0, 0] } else { [n; 3] };
        writeln!(
            out,
            "{kind} accelerogram 20990101_000000_TEST_20 GNS Science\nSite TEST      42 37 10S  \
                173 03 13E"
        )
        .unwrap();
        writeln!(
            out,
            "Made up Farm\nInstrument None_1\nResolution: 18-bit\nAccelerogram TEST\nnowhere\n\
                2099 January 01"
        )
        .unwrap();
        writeln!(
            out,
            "Epicentre  42 41 33S\nNumber of points  {n}    Duration {:.2} sec",
            n as f64 * DT
        )
        .unwrap();
        match raw {
            true => writeln!(out, "Raw readings in units of 1.00 mm/s/s  at intervals of 0.020 s")
                .unwrap(),
            false => writeln!(out, "Instrument corrected data at 0.020 sec intervals").unwrap(),
        }
        writeln!(out, "Filter\nComponent {name}  Accelerometer Axis").unwrap();
        for (i, (what, unit)) in
            [("Acceleration:", "mm/s/s"), ("Velocity:", "mm/s"), ("Displacement:", "mm")]
                .into_iter()
                .enumerate()
        {
            let (value, time) = peak(&series[i]);
            match counts[i] {
                0 => writeln!(out, "{what} record unevaluated").unwrap(),
                _ => {
                    let time = time - if raw { 0.0 } else { PREPENDED };
                    writeln!(
                        out,
                        "{what}  peak {value:8.1} {unit} at {time:6.2} sec     rms  1.0 {unit}"
                    )
                    .unwrap();
                }
            }
        }
        for line in 0..4 {
            for i in 0..10 {
                let value = if line == 3 && (3..6).contains(&i) { counts[i - 3] } else { 7 };
                write!(out, "{value:8}").unwrap();
            }
            out.push('\n');
        }
        for line in 0..6 {
            let number = |i| match (line, i) {
                (2, 5) => DT,
                (2, 1) if !raw => PREPENDED,
                _ => 0.0,
            };
            rows(&mut out, &(0..10).map(number).collect::<Vec<f64>>(), 10, 8, 4);
        }
        for values in &series[..if raw { 1 } else { 3 }] {
            rows(&mut out, values, 10, 8, 1);
        }
    }
    out
}

/// COSMOS: each channel an azimuth (or a code) and its acceleration in a unit of that code.
pub fn cosmos(channels: &[(i64, f64)], (unit, code): (&str, u32)) -> String {
    let mut out = String::new();
    for (i, (azimuth, scale)) in channels.iter().enumerate() {
        let values = rounded(&wave(*scale, 0.3), 5);
        let (value, time) = peak(&values);
        writeln!(out, "Corrected acceleration    (Format v01.20 with 13 text lines) Src: made up")
            .unwrap();
        writeln!(
            out,
            "Record of nothing\nHypocenter:\nOrigin:\nStatn No: 01-1  Code:XX-TEST  Test   Place"
        )
        .unwrap();
        writeln!(
            out,
            "Coords:\nRecorder:\nRcrd start time:\n\
                Sta Chan  {}: 45 deg (Rcrdr Chan  1) Location: roof\nRaw\nProcessed",
            i + 1
        )
        .unwrap();
        writeln!(
            out,
            "Filtered\nValues used when parameter or data value is unknown/unspecified:   -999, \
                -999.00"
        )
        .unwrap();
        writeln!(out, " 100 Integer-header values follow on  10 lines, Format= (10I8)").unwrap();
        for line in 0..10 {
            for j in 0..10 {
                write!(out, "{:8}", if (line, j) == (5, 3) { *azimuth } else { -999 }).unwrap();
            }
            out.push('\n');
        }
        writeln!(out, " 100 Real-header values follow on  20 lines, Format= (5F15.6)").unwrap();
        let mut numbers = vec![-999.0; 100];
        // the raw record had another step
        (numbers[33], numbers[61], numbers[62]) = (0.005, 1e3 * DT, SAMPLES as f64 * DT);
        (numbers[63], numbers[64]) = (value, time);
        rows(&mut out, &numbers, 5, 15, 6);
        writeln!(out, "   2 Comment line(s) follow, each starting with a \"|\":\n| one\n| two")
            .unwrap();
        writeln!(
            out,
            "     {SAMPLES} acceleration pts, approx    4 secs, \
                units={unit}({code:02}),Format=(8F10.5)"
        )
        .unwrap();
        rows(&mut out, &values, 8, 10, 5);
        writeln!(out, "End-of-data for Chan {} acceleration", i + 1).unwrap();
    }
    out
}

/// CSMIP .V2: each channel a direction and its acceleration in cm/s2.
pub fn csmip(channels: &[(&str, f64)]) -> String {
    let mut out = String::new();
    for (i, (direction, scale)) in channels.iter().enumerate() {
        let chan = i + 1;
        let series = [wave(*scale, 0.3), wave(scale / 10.0, 0.9), wave(scale / 100.0, 1.4)];
        let series = series.map(|values| rounded(&values, 4));
        writeln!(
            out,
            "Corrected accelerogram   12345                      Chan  {chan}: {direction}     \
                from   "
        )
        .unwrap();
        writeln!(
            out,
            "Uncorrected Accelerogram Data             Processed: 01/01/99\nRecord of nothing\n\
                (Origin)\n12345"
        )
        .unwrap();
        writeln!(
            out,
            "Station No. 12345   34.009N, 117.951W\nTest Place                               CGS"
        )
        .unwrap();
        writeln!(out, "Chan  {chan}: {direction}").unwrap();
        out.push_str(&"text\n".repeat(9));
        let names =
            [("acceleration", "cm/sec/sec"), ("velocity", "cm/sec"), ("displacement", "cm")];
        for ((what, unit), values) in names.into_iter().zip(&series) {
            let (value, time) = peak(values);
            writeln!(out, "Peak {what:>12} = {value:9.3}    {unit}  at  {time:7.3}   sec.")
                .unwrap();
        }
        out.push_str(&"text\n".repeat(5));
        for count in [16, 16, 16, 16, 16, 16, 4] {
            writeln!(out, "{}", "    7".repeat(count)).unwrap();
        }
        for line in 0..13 {
            let numbers: Vec<f64> =
                (0..8).map(|j| if (line, j) == (6, 4) { DT } else { 0.5 }).collect();
            rows(&mut out, &numbers[..if line == 12 { 4 } else { 8 }], 8, 10, 7);
        }
        for ((what, unit), values) in
            [("accel", "cm/sec2."), ("veloc", "cm/sec."), ("displ", "cm.")].into_iter().zip(&series)
        {
            writeln!(
                out,
                "   {SAMPLES} points of {what} data equally spaced at  .020 sec, in {unit} \
                    (8f10.4)    "
            )
            .unwrap();
            rows(&mut out, values, 8, 10, 4);
        }
        writeln!(out, "/&  ----------  End of data for channel  {chan}  ----------").unwrap();
    }
    out.replace('\n', "\r\n")
}

/// The counts of a K-NET file, and its acceleration in gal.
pub fn knet_counts() -> (Vec<i64>, Vec<f64>) {
    let scale = 3920.0 / 6_182_761.0;
    // 204 counts at 100 Hz, 3 s less a little: durations are whole seconds
    let counts: Vec<i64> =
        wave(40.0, 0.3)[..200].iter().map(|gal| 8000 + (gal / scale).round() as i64).collect();
    let mean = counts.iter().sum::<i64>() as f64 / counts.len() as f64;
    let gal = counts.iter().map(|count| (*count as f64 - mean) * scale).collect();
    (counts, gal)
}

/// K-NET; for KiK-net the direction is the number of a channel.
pub fn knet(direction: &str) -> String {
    let (counts, gal) = knet_counts();
    let (value, _) = peak(&gal);
    let mut out = String::from(
        "Origin Time       2099/01/01 00:00:00\nLat.              38.103\n\
            Long.             142.860\n",
    );
    out.push_str(
        "Depth. (km)       24\nMag.              7.0\nStation Code      TST001\n\
            Station Lat.      38.7\n",
    );
    out.push_str(
        "Station Long.     141.0\nStation Height(m) 40\nRecord Time       2099/01/01 00:00:30\n",
    );
    out.push_str("Sampling Freq(Hz) 100Hz\nDuration Time(s)  2\n");
    writeln!(out, "Dir.              {direction}\nScale Factor      3920(gal)/6182761").unwrap();
    writeln!(out, "Max. Acc. (gal)   {:.3}", value.abs()).unwrap();
    out.push_str("Last Correction   2099/01/01 00:00:21\nMemo.             \n");
    for row in counts.chunks(8) {
        let row: Vec<String> = row.iter().map(|count| format!("{count:8}")).collect();
        writeln!(out, "{}", row.join(" ")).unwrap();
    }
    out
}

/// ESM, ITACA, AFAD.
pub fn dyna(stream: &str, scale: f64) -> String {
    let values = rounded(&wave(scale, 0.3), 6);
    let (value, time) = peak(&values);
    let mut out = String::from(
        "EVENT_NAME: nothing\nEVENT_ID: 1\nEVENT_TIME_HHMMSS: 23:08:25\nNETWORK: XX\n\
            STATION_CODE: TST\n",
    );
    writeln!(
        out,
        "STATION_NAME: Test Place\nVS30_M/S: \nSAMPLING_INTERVAL_S: {DT:.6}\nNDATA: {SAMPLES}"
    )
    .unwrap();
    writeln!(out, "STREAM: {stream}\nUNITS: cm/s^2\nPGA_CM/S^2: {value:.6}\nTIME_PGA_S: {time:.6}")
        .unwrap();
    out.push_str("HEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\nUSER5: \n");
    rows(&mut out, &values, 1, 0, 6);
    out
}
