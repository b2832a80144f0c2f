// cmp PARAMS.json OPENSEES.csv : ours against opensees
use groundspring::*; use groundspring::spring::*;
fn main(){
    let a:Vec<String>=std::env::args().collect();
    let text=std::fs::read_to_string("tuning/records/IELC180.AT2").unwrap();
    let accel:Vec<f64>=text.lines().skip(4).flat_map(|l|l.split_whitespace()).map(|x|x.parse::<f64>().unwrap()*9.81).collect();
    let p:serde_json::Value=serde_json::from_str(&std::fs::read_to_string(&a[1]).unwrap()).unwrap();
    let st=&p["structure"];
    let body=structure::Body{mass:st["mass_kg"].as_f64().unwrap(),half_width:st["width_m"].as_f64().unwrap()/2.,height:st["height_m"].as_f64().unwrap(),inertia:st["rotational_inertia_kgm2"].as_f64().unwrap()};
    let ch=|n:&str|serde_json::from_value::<ChainRow>(p[n].clone()).unwrap().chain();
    let springs=Springs{vertical:ch("vertical"),horizontal:ch("horizontal")};
    let rows:Vec<Vec<f64>>=std::fs::read_to_string(&a[2]).unwrap().lines().skip(1).map(|l|l.split(',').map(|x|x.parse().unwrap()).collect()).collect();
    let mut r=fem::Recorder::default();
    let o=fem::simulate(&body,&springs,0.01,&accel,1.0,rows.len(),fem::Control{tolerance:1e-10,..Default::default()},&mut r);
    let u:Vec<f64>=rows.iter().map(|r|r[1]).collect(); let v:Vec<f64>=rows.iter().map(|r|r[2]).collect();let th:Vec<f64>=rows.iter().map(|r|r[3]).collect();
    println!("{} {:?} events {} residual {:.1e} u {:.2e} v {:.2e} th {:.2e} peak {:.2}",a[1],o.1,r.events.len(),r.worst/o.2,motion::nrmse(&r.motion.u,&u),motion::nrmse(&r.motion.v,&v),motion::nrmse(&r.motion.theta,&th),motion::peak(&r.motion.u)*1e3);
}
